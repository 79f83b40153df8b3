#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "hlod/core/aabb.h"
#include "hlod/render/gl_object.h"
#include "hlod/view/camera.h"

namespace hlodbench {

// Lines over a picture: boxes and frusta. Those behind what was drawn show faintly.
class LineDrawing {
 public:
  using Color = std::array<std::uint8_t, 3>;  // RGB as shown

  LineDrawing();

  void addLine(const glm::dvec3& from, const glm::dvec3& to, const Color& color);
  void addBox(const Aabb& box, const Color& color);
  // The part of space that the camera sees, its far plane taken at `distance`, world units.
  void addFrustum(const Camera& camera, double distance, const Color& color);
  // Draws what was added into the framebuffer that is bound, whose depth is the picture's, and
  // forgets it. To be called after the picture's last node; Renderer::beginFrame() comes next.
  void draw(const Camera& camera);

 private:
  struct Vertex {
    glm::vec3 position;
    std::array<std::uint8_t, 4> color;
  };

  std::vector<Vertex> vertices_;
  GlProgram program_;
  GLint matrix_, opacity_;
  GlVertexArray array_;
  GlBuffer buffer_;
};

}  // namespace hlodbench
