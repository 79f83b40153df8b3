#pragma once

#include <glm/glm.hpp>

#include <limits>

namespace hlodbench {

// Axis-aligned box in world units. A default-constructed box is empty (min > max).
struct Aabb {
  glm::vec3 min{std::numeric_limits<float>::infinity()};
  glm::vec3 max{-std::numeric_limits<float>::infinity()};

  void extend(const glm::vec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void extend(const Aabb& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  [[nodiscard]] bool empty() const { return min.x > max.x; }
  [[nodiscard]] bool contains(const Aabb& other) const {
    return glm::all(glm::lessThanEqual(min, other.min)) &&
           glm::all(glm::greaterThanEqual(max, other.max));
  }
  [[nodiscard]] float diagonal() const { return empty() ? 0.0f : glm::length(max - min); }
};

}  // namespace hlodbench
