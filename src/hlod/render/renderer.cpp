#include "hlod/render/renderer.h"

#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <stdexcept>

#include "hlod/render/gl_debug.h"
#include "hlod/render/gl_program.h"

namespace hlodbench {
namespace {

constexpr const char* kNodeVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
uniform mat4 viewProjection;
out vec3 worldNormal;
out vec3 albedo;
void main() {
  worldNormal = normal;
  albedo = color.rgb;
  gl_Position = viewProjection * vec4(position, 1.0);
})";

// a sun, and light from the sky and from the ground; both faces are lit as seen
constexpr const char* kLitFragmentShader = R"(#version 330 core
in vec3 worldNormal;
in vec3 albedo;
out vec4 fragment;
const vec3 kSun = vec3(0.408, 0.816, 0.408);
void main() {
  vec3 n = normalize(gl_FrontFacing ? worldNormal : -worldNormal);
  vec3 sky = mix(vec3(0.20, 0.17, 0.15), vec3(0.42, 0.50, 0.62), 0.5 + 0.5 * n.y);
  vec3 light = sky + vec3(0.72, 0.66, 0.55) * max(0.0, dot(n, kSun));
  fragment = vec4(sqrt(albedo * light), 1.0);
})";

// the same light, without its colour
constexpr const char* kTintedFragmentShader = R"(#version 330 core
in vec3 worldNormal;
uniform vec3 tint;
out vec4 fragment;
const vec3 kSun = vec3(0.408, 0.816, 0.408);
void main() {
  vec3 n = normalize(gl_FrontFacing ? worldNormal : -worldNormal);
  float light = mix(0.25, 0.5, 0.5 + 0.5 * n.y) + 0.5 * max(0.0, dot(n, kSun));
  fragment = vec4(sqrt(tint * light), 1.0);
})";

constexpr const char* kObjectVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 3) in uint object;
uniform mat4 viewProjection;
flat out uint index;
void main() {
  index = object;
  gl_Position = viewProjection * vec4(position, 1.0);
})";

constexpr const char* kObjectFragmentShader = R"(#version 330 core
flat in uint index;
out vec4 fragment;
void main() {
  fragment = vec4(float(index & 255u) / 255.0, float(index >> 8u) / 255.0, 0.0, 1.0);
})";

constexpr const char* kBoxVertexShader = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 viewProjection;
void main() { gl_Position = viewProjection * vec4(position, 1.0); })";

constexpr const char* kBoxFragmentShader = R"(#version 330 core
void main() {})";

// Corner i of a box: bit 0 = max x, bit 1 = max y, bit 2 = max z. Counter-clockwise from outside.
constexpr GLushort kBoxTriangles[36] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                        2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};

bool hasNarrowIndices(const Node& node) {
  return node.vertexCount <= 65536;
}

void fillBuffer(GLenum target, GLuint buffer, const std::string& label, const void* data,
                std::size_t size) {
  while (glGetError() != GL_NO_ERROR) {
  }
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(size), data, GL_STATIC_DRAW);
  if (glGetError() == GL_OUT_OF_MEMORY)
    throw std::runtime_error("no memory for " + std::to_string(size >> 20) + " MiB of " + label);
  labelGlObject(GL_BUFFER, buffer, label);
}

void setAttribute(GLuint index, GLint components, GLenum type, bool normalized, std::size_t stride,
                  std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, components, type, normalized ? GL_TRUE : GL_FALSE,
                        static_cast<GLsizei>(stride), reinterpret_cast<const void*>(offset));
}

}  // namespace

Renderer::Program::Program(GlProgram linked)
    : program(std::move(linked)),
      matrix(glGetUniformLocation(program, "viewProjection")),
      tint(glGetUniformLocation(program, "tint")) {}

Renderer::Renderer(const Hierarchy& hierarchy, int width, int height)
    : hierarchy_(hierarchy),
      framebuffer_(width, height),
      nodePrograms_{
          Program(makeGlProgram("nodes, lit", kNodeVertexShader, kLitFragmentShader)),
          Program(makeGlProgram("nodes, objects", kObjectVertexShader, kObjectFragmentShader)),
          Program(makeGlProgram("nodes, tinted", kNodeVertexShader, kTintedFragmentShader))},
      boxProgram_(makeGlProgram("boxes", kBoxVertexShader, kBoxFragmentShader)) {
  uploadGeometry();
  uploadBoxes();
}

void Renderer::uploadGeometry() {
  glBindVertexArray(nodeArray_);
  fillBuffer(GL_ARRAY_BUFFER, vertices_, "node vertices", hierarchy_.vertices.data(),
             hierarchy_.vertices.size() * sizeof(Vertex));
  uploadIndices();
  setAttribute(0, 3, GL_FLOAT, false, sizeof(Vertex), offsetof(Vertex, position));
  setAttribute(1, 3, GL_SHORT, true, sizeof(Vertex), offsetof(Vertex, normal));
  setAttribute(2, 4, GL_UNSIGNED_BYTE, true, sizeof(Vertex), offsetof(Vertex, color));
  glEnableVertexAttribArray(3);
  glVertexAttribIPointer(3, 1, GL_UNSIGNED_SHORT, sizeof(Vertex),
                         reinterpret_cast<const void*>(offsetof(Vertex, object)));
}

// In 16 bits where they fit, which nearly all nodes do; 32-bit ones stay aligned.
void Renderer::uploadIndices() {
  std::vector<std::byte> bytes;
  bytes.reserve(hierarchy_.indices.size() * sizeof(std::uint16_t));
  const auto append = [&](const auto* indices, std::size_t count) {
    const auto* begin = reinterpret_cast<const std::byte*>(indices);
    bytes.insert(bytes.end(), begin, begin + count * sizeof(*indices));
  };
  std::vector<std::uint16_t> narrow;
  for (const Node& node : hierarchy_.nodes) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    indexOffsets_.push_back(bytes.size());
    const std::uint32_t* indices = hierarchy_.indices.data() + node.firstIndex;
    if (hasNarrowIndices(node)) {
      narrow.assign(indices, indices + node.indexCount);
      append(narrow.data(), narrow.size());
    } else {
      append(indices, node.indexCount);
    }
  }
  fillBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_, "node indices", bytes.data(), bytes.size());
}

void Renderer::uploadBoxes() {
  std::vector<glm::vec3> corners;
  corners.reserve(8 * hierarchy_.nodes.size());
  for (const Node& node : hierarchy_.nodes)
    for (int i = 0; i < 8; ++i)
      corners.emplace_back((i & 1) ? node.box.max.x : node.box.min.x,
                           (i & 2) ? node.box.max.y : node.box.min.y,
                           (i & 4) ? node.box.max.z : node.box.min.z);
  glBindVertexArray(boxArray_);
  fillBuffer(GL_ARRAY_BUFFER, boxCorners_, "box corners", corners.data(),
             corners.size() * sizeof(glm::vec3));
  fillBuffer(GL_ELEMENT_ARRAY_BUFFER, boxIndices_, "box indices", kBoxTriangles,
             sizeof kBoxTriangles);
  setAttribute(0, 3, GL_FLOAT, false, sizeof(glm::vec3), 0);
}

void Renderer::beginFrame(const Camera& camera, Shading shading) {
  framebuffer_.bind();
  shading_ = shading;
  lens_ = camera.lens;
  const glm::mat4 matrix(camera.viewProjection);
  for (const Program* used : std::array<const Program*, 2>{&boxProgram_, &nodeProgram()}) {
    glUseProgram(used->program);
    glUniformMatrix4fv(used->matrix, 1, GL_FALSE, glm::value_ptr(matrix));
  }
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glCullFace(GL_BACK);
  // boxes that lie in the plane of geometry, as those of walls do, must not fail the depth test for
  // rounding: a query may see too much, never too little
  glPolygonOffset(-1.0f, -1.0f);
  state_ = State::kNone;
  setState(State::kNodes);
  if (shading == Shading::kObjects)
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  else
    glClearColor(0.62f, 0.74f, 0.86f, 0.0f);  // a sky; alpha 0: nothing was drawn here
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Renderer::setTint(const glm::vec3& color) {
  setState(State::kNodes);
  if (shading_ == Shading::kTinted) glUniform3fv(nodeProgram().tint, 1, glm::value_ptr(color));
}

DepthImage Renderer::readDepth() const {
  DepthImage image{framebuffer_.width(), framebuffer_.height(), framebuffer_.readDepth()};
  const double n = lens_.nearPlane;
  const double f = lens_.farPlane;
  for (float& depth : image.depth)
    depth = depth < 1.0f ? static_cast<float>(f * n / (f - depth * (f - n)))
                         : std::numeric_limits<float>::infinity();
  return image;
}

void Renderer::setState(State state) {
  if (state == state_) return;
  state_ = state;
  const bool boxes = state == State::kBoxes;
  const GLboolean write = boxes ? GL_FALSE : GL_TRUE;
  glColorMask(write, write, write, write);
  glDepthMask(write);
  if (boxes) {
    glEnable(GL_CULL_FACE);  // each covered pixel must pass once
    glEnable(GL_POLYGON_OFFSET_FILL);
  } else {
    glDisable(GL_CULL_FACE);
    glDisable(GL_POLYGON_OFFSET_FILL);
  }
  glUseProgram(boxes ? boxProgram_.program : nodeProgram().program);
  glBindVertexArray(boxes ? boxArray_ : nodeArray_);
}

void Renderer::drawNode(NodeId id) {
  setState(State::kNodes);
  const Node& node = hierarchy_.node(id);
  // with the range of indices, a software rasteriser shades each vertex once
  glDrawRangeElementsBaseVertex(GL_TRIANGLES, 0, node.vertexCount > 0 ? node.vertexCount - 1 : 0,
                                static_cast<GLsizei>(node.indexCount),
                                hasNarrowIndices(node) ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(indexOffsets_[id]),
                                static_cast<GLint>(node.firstVertex));
}

void Renderer::drawBox(NodeId id) {
  setState(State::kBoxes);
  glDrawElementsBaseVertex(GL_TRIANGLES, 36, GL_UNSIGNED_SHORT, nullptr,
                           static_cast<GLint>(8 * id));
}

}  // namespace hlodbench
