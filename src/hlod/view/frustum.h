#pragma once

#include <array>

#include <glm/glm.hpp>

#include "hlod/core/aabb.h"
#include "hlod/view/camera.h"

namespace hlodbench {

// The six planes of the view frustum in world space, pointing inwards.
class Frustum {
 public:
  explicit Frustum(const Camera& camera);

  // False only when the box lies wholly behind one of the planes: conservative, as usual for
  // hierarchical culling; a box near a frustum edge may be kept although it is outside.
  [[nodiscard]] bool intersects(const Aabb& box) const;

 private:
  std::array<glm::dvec4, 6> planes_;
};

}  // namespace hlodbench
