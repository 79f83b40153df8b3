#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/core/aabb.h"

namespace hlodbench {

// Squared distance from a point to a triangle (a, b, c), which may be degenerate. The closest-point
// regions are those of Ericson, Real-Time Collision Detection, 5.1.5.
float pointTriangleDistanceSquared(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b,
                                   const glm::vec3& c);

// Distances from points to a set of triangles, through a tree of boxes.
class SurfaceDistance {
 public:
  // corners: 3 a triangle, at least one triangle.
  explicit SurfaceDistance(std::span<const glm::vec3> corners);

  // The squared distance from p to the nearest triangle; but once some triangle is found within
  // sqrt(enough), the search ends and the value returned is only known to be at most `enough`.
  // hint: where to look first, and then the triangle found; queries of points that lie near each
  // other should share it. Any value below the number of triangles will do to start with.
  [[nodiscard]] float distanceSquared(const glm::vec3& p, float enough, std::uint32_t& hint) const;

  // The squared distance from p to the triangle that was found as `hint`.
  [[nodiscard]] float distanceSquaredTo(std::uint32_t hint, const glm::vec3& p) const;

 private:
  struct Triangle {
    glm::vec3 a, b, c;
  };
  // A leaf when count > 0; else the children are the next node and node `first`.
  struct Box {
    Aabb bounds;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  void build(std::uint32_t begin, std::uint32_t end);

  std::vector<Triangle> triangles_;
  std::vector<Box> boxes_;
};

}  // namespace hlodbench
