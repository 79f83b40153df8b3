#include "hlod/view/frustum.h"

namespace hlodbench {

Frustum::Frustum(const Camera& camera) {
  // rows of the view-projection matrix: -w <= x, y, z <= w in clip space
  const glm::dmat4 rows = glm::transpose(camera.viewProjection);
  for (int axis = 0; axis < 3; ++axis) {
    planes_[2 * axis] = rows[3] + rows[axis];
    planes_[2 * axis + 1] = rows[3] - rows[axis];
  }
}

bool Frustum::intersects(const Aabb& box) const {
  for (const glm::dvec4& plane : planes_) {
    // the corner farthest along the plane's normal
    const glm::dvec3 corner(plane.x > 0 ? box.max.x : box.min.x,
                            plane.y > 0 ? box.max.y : box.min.y,
                            plane.z > 0 ? box.max.z : box.min.z);
    if (glm::dot(glm::dvec3(plane), corner) + plane.w < 0.0) return false;
  }
  return true;
}

}  // namespace hlodbench
