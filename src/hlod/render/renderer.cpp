#include "hlod/render/renderer.h"

#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <limits>

#include "hlod/render/gl_fill_buffer.h"
#include "hlod/render/gl_program.h"
#include "hlod/render/shaders.h"

namespace hlodbench {
namespace {

// Corner i of a box: bit 0 = max x, bit 1 = max y, bit 2 = max z. Counter-clockwise from outside.
constexpr GLushort kBoxTriangles[36] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                        2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};

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

Renderer::Renderer(const Hierarchy& hierarchy, int width, int height,
                   const RendererOptions& options)
    : hierarchy_(hierarchy),
      options_(options),
      residency_(hierarchy, options.gpuMemory, options.mostPageBytes),
      framebuffer_(width, height),
      nodePrograms_{
          Program(makeGlProgram("nodes, lit", shaders::kNodeVertex, shaders::kLitFragment)),
          Program(
              makeGlProgram("nodes, objects", shaders::kObjectVertex, shaders::kObjectFragment)),
          Program(makeGlProgram("nodes, tinted", shaders::kNodeVertex, shaders::kTintedFragment)),
          Program(makeGlProgram("nodes, flat", shaders::kPlainVertex, shaders::kFlatFragment)),
          Program(makeGlProgram("triangles", shaders::kPlainVertex, shaders::kTriangleFragment))},
      boxProgram_(makeGlProgram("boxes", shaders::kPlainVertex, shaders::kBoxFragment)),
      nodeArrays_(residency_.pages().size()) {
  describeGeometry();
  uploadColors();
  uploadBoxes();
}

// A page holds vertices and indices, block after block as in the file.
void Renderer::describeGeometry() {
  for (std::size_t page = 0; page < nodeArrays_.size(); ++page) {
    glBindVertexArray(nodeArrays_[page]);
    glBindBuffer(GL_ARRAY_BUFFER, residency_.pages()[page]);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, residency_.pages()[page]);
    setAttribute(0, 3, GL_FLOAT, false, sizeof(Vertex), offsetof(Vertex, position));
    // not normalised by OpenGL, whose versions do it differently
    setAttribute(1, 2, GL_BYTE, false, sizeof(Vertex), offsetof(Vertex, normal));
    glEnableVertexAttribArray(2);
    glVertexAttribIPointer(2, 1, GL_UNSIGNED_SHORT, sizeof(Vertex),
                           reinterpret_cast<const void*>(offsetof(Vertex, object)));
  }
}

void Renderer::uploadColors() {
  std::vector<glm::vec4> colors;
  for (const SceneObject& object : hierarchy_.objects) colors.emplace_back(object.color, 1.0f);
  if (colors.empty()) colors.emplace_back(1.0f);
  fillBuffer(GL_TEXTURE_BUFFER, colors_, "object colors", colors.data(),
             colors.size() * sizeof(glm::vec4));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_BUFFER, colorTexture_);
  glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, colors_);
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
  residency_.beginFrame();
  framebuffer_.bind();
  shading_ = shading;
  lens_ = camera.lens;
  const glm::mat4 matrix(camera.viewProjection);
  for (const Program* used : std::array<const Program*, 2>{&boxProgram_, &nodeProgram()}) {
    glUseProgram(used->program);
    glUniformMatrix4fv(used->matrix, 1, GL_FALSE, glm::value_ptr(matrix));
  }
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_BUFFER, colorTexture_);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glCullFace(GL_BACK);
  // boxes that lie in the plane of geometry, as those of walls do, must not fail the depth test for
  // rounding: a query may see too much, never too little
  glPolygonOffset(-1.0f, -1.0f);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_CLAMP);
  isCulling_ = false;
  state_ = State::kNone;
  setState(State::kNodes);
  const bool showsNumbers =
      shading == Shading::kObjects || shading == Shading::kFlat || shading == Shading::kTriangles;
  if (showsNumbers)
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  else
    glClearColor(0.62f, 0.74f, 0.86f, 0.0f);  // a sky; alpha 0: nothing was drawn here
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Renderer::resize(int width, int height) {
  if (width != framebuffer_.width() || height != framebuffer_.height())
    framebuffer_ = Framebuffer(width, height);
}

void Renderer::show(GLuint target, int x, int y, int width, int height) {
  framebuffer_.blit(target, x, y, width, height);
  setState(State::kNodes);  // boxes mask all writing
  glBindFramebuffer(GL_FRAMEBUFFER, target);
}

void Renderer::setTint(const glm::vec3& color) {
  setState(State::kNodes);
  if (nodeProgram().tint >= 0) glUniform3fv(nodeProgram().tint, 1, glm::value_ptr(color));
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
  const auto enable = boxes ? glEnable : glDisable;
  enable(GL_POLYGON_OFFSET_FILL);
  if (!options_.clipsBoxes) enable(GL_DEPTH_CLAMP);
  glUseProgram(boxes ? boxProgram_.program : nodeProgram().program);
  glBindVertexArray(boxes ? boxArray_ : nodeArrays_[page_]);
}

void Renderer::setCulling(bool on) {
  if (on == isCulling_) return;
  isCulling_ = on;
  if (on)
    glEnable(GL_CULL_FACE);
  else
    glDisable(GL_CULL_FACE);
}

void Renderer::setPage(std::uint32_t page) {
  if (page == page_) return;
  page_ = page;
  glBindVertexArray(nodeArrays_[page]);
}

void Renderer::setKind(const Kind& kind) {
  setState(State::kNodes);
  setCulling(kind.isCulled);
  setPage(kind.page);
}

Renderer::Kind Renderer::kindOf(NodeId id) const {
  const Node& node = hierarchy_.node(id);
  return {options_.culling == FaceCulling::kBackWhereConsistent &&
              (node.flags & kConsistentWinding) != 0,
          static_cast<GLenum>(node.hasNarrowIndices() ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT),
          residency_.place(id).page};
}

GLint Renderer::firstVertex(NodeId id) const {
  return static_cast<GLint>(residency_.place(id).offset / sizeof(Vertex));
}

const void* Renderer::indexPlace(NodeId id) const {
  return reinterpret_cast<const void*>(residency_.place(id).offset +
                                       hierarchy_.node(id).vertexCount * sizeof(Vertex));
}

void Renderer::drawNode(NodeId wanted) {
  const NodeId id = residency_.choose(wanted);
  if (id == kNoNode) return;
  const Node& node = hierarchy_.node(id);
  const Kind kind = kindOf(id);
  setKind(kind);
  // with the range of indices, a software rasteriser shades each vertex once
  glDrawRangeElementsBaseVertex(GL_TRIANGLES, 0, node.vertexCount > 0 ? node.vertexCount - 1 : 0,
                                static_cast<GLsizei>(node.indexCount), kind.indexType,
                                indexPlace(id), firstVertex(id));
}

void Renderer::drawNodes(std::span<const NodeId> nodes) {
  while (!nodes.empty()) {
    const std::size_t there = residency_.loadNow(nodes);
    drawThere(nodes.first(there));
    nodes = nodes.subspan(there);
  }
}

void Renderer::drawThere(std::span<const NodeId> nodes) {
  while (!nodes.empty()) {
    const Kind kind = kindOf(nodes[0]);
    counts_.clear();
    indexPlaces_.clear();
    firstVertices_.clear();
    for (const NodeId id : nodes) {
      if (kindOf(id) != kind) break;
      counts_.push_back(static_cast<GLsizei>(hierarchy_.node(id).indexCount));
      indexPlaces_.push_back(indexPlace(id));
      firstVertices_.push_back(firstVertex(id));
    }
    setKind(kind);
    glMultiDrawElementsBaseVertex(GL_TRIANGLES, counts_.data(), kind.indexType, indexPlaces_.data(),
                                  static_cast<GLsizei>(counts_.size()), firstVertices_.data());
    nodes = nodes.subspan(counts_.size());
  }
}

void Renderer::drawBox(NodeId id) {
  setState(State::kBoxes);
  setCulling(options_.queryFaces == QueryFaces::kFront);
  glDrawElementsBaseVertex(GL_TRIANGLES, 36, GL_UNSIGNED_SHORT, nullptr,
                           static_cast<GLint>(8 * id));
}

}  // namespace hlodbench
