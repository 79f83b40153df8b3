#pragma once

#include <glm/glm.hpp>

#include "hlod/core/aabb.h"

namespace hlodbench {

// A node's own coordinates: its box's centre is 0 and its longest side runs from -1 to 1, so that
// simplification and measuring do not depend on how large, or how far from the origin, a scene is.
class NodeFrame {
 public:
  explicit NodeFrame(const Aabb& box) : centre_((glm::dvec3(box.min) + glm::dvec3(box.max)) * 0.5) {
    const glm::dvec3 extent = glm::dvec3(box.max) - glm::dvec3(box.min);
    const double longest = glm::max(extent.x, glm::max(extent.y, extent.z));
    unit_ = longest > 0.0 ? longest * 0.5 : 1.0;
    scale_ = 1.0 / unit_;
  }
  [[nodiscard]] glm::vec3 toLocal(const glm::dvec3& world) const {
    return glm::vec3((world - centre_) * scale_);
  }
  // World units in one local unit.
  [[nodiscard]] double unit() const { return unit_; }

 private:
  glm::dvec3 centre_;
  double unit_ = 1.0;
  double scale_ = 1.0;
};

}  // namespace hlodbench
