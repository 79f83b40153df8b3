#include "hlod/render/line_drawing.h"

#include <cmath>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>

#include "hlod/render/gl_fill_buffer.h"
#include "hlod/render/gl_program.h"
#include "hlod/render/shaders.h"

namespace hlodbench {
namespace {

constexpr float kHiddenOpacity = 0.25f;

// Corner i: bit 0 = max x, bit 1 = max y, bit 2 = max z; the corners of an edge differ in one bit.
template <typename AddLine>
void addEdges(const std::array<glm::dvec3, 8>& corners, AddLine addLine) {
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4})
      if ((i & bit) == 0) addLine(corners[i], corners[i | bit]);
}

}  // namespace

LineDrawing::LineDrawing()
    : program_(makeGlProgram("lines", shaders::kLineVertex, shaders::kLineFragment)),
      matrix_(glGetUniformLocation(program_, "viewProjection")),
      opacity_(glGetUniformLocation(program_, "opacity")) {
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), nullptr);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Vertex),
                        reinterpret_cast<const void*>(offsetof(Vertex, color)));
}

void LineDrawing::addLine(const glm::dvec3& from, const glm::dvec3& to, const Color& color) {
  for (const glm::dvec3& end : {from, to})
    vertices_.push_back({glm::vec3(end), {color[0], color[1], color[2], 255}});
}

void LineDrawing::addBox(const Aabb& box, const Color& color) {
  std::array<glm::dvec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[i] = {(i & 1) ? box.max.x : box.min.x, (i & 2) ? box.max.y : box.min.y,
                  (i & 4) ? box.max.z : box.min.z};
  addEdges(corners, [&](const auto& from, const auto& to) { addLine(from, to, color); });
}

void LineDrawing::addFrustum(const Camera& camera, double distance, const Color& color) {
  const Lens& lens = camera.lens;
  const double slope = std::tan(0.5 * lens.fovyRad);
  std::array<glm::dvec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const double depth = (i & 4) ? distance : lens.nearPlane;
    const double y = slope * depth;
    const double x = y * lens.width / lens.height;
    corners[i] = camera.pose.position +
                 camera.pose.orientation * glm::dvec3((i & 1) ? x : -x, (i & 2) ? y : -y, -depth);
  }
  addEdges(corners, [&](const auto& from, const auto& to) { addLine(from, to, color); });
}

void LineDrawing::draw(const Camera& camera) {
  if (vertices_.empty()) return;
  glUseProgram(program_);
  glUniformMatrix4fv(matrix_, 1, GL_FALSE, glm::value_ptr(glm::mat4(camera.viewProjection)));
  glBindVertexArray(array_);
  fillBuffer(GL_ARRAY_BUFFER, buffer_, "lines", vertices_.data(), vertices_.size() * sizeof(Vertex),
             GL_STREAM_DRAW);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);  // alpha tells where a node was drawn
  glDepthMask(GL_FALSE);
  glDisable(GL_POLYGON_OFFSET_FILL);
  const auto count = static_cast<GLsizei>(vertices_.size());
  glUniform1f(opacity_, 1.0f);
  glDepthFunc(GL_LEQUAL);
  glDrawArrays(GL_LINES, 0, count);
  glUniform1f(opacity_, kHiddenOpacity);
  glDepthFunc(GL_GREATER);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDrawArrays(GL_LINES, 0, count);
  glDisable(GL_BLEND);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  vertices_.clear();
}

}  // namespace hlodbench
