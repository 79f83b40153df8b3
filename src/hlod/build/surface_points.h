#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "hlod/build/random.h"
#include "hlod/build/welded_mesh.h"

namespace hlodbench {

// The corners of a triangle, world units.
struct Corners {
  glm::dvec3 a, b, c;
  [[nodiscard]] double area() const { return 0.5 * glm::length(glm::cross(b - a, c - a)); }
};

inline Corners cornersOf(const WeldedMesh& mesh, const glm::uvec3& t) {
  return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

// Uniform over the triangle.
inline glm::dvec3 randomPoint(const Corners& t, Random& random) {
  double u = random.next();
  double v = random.next();
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return t.a + (t.b - t.a) * u + (t.c - t.a) * v;
}

// Deals a number of points out to triangles, evenly by area: marks stand at equal distances along
// the sum of the areas, the first at a random place.
class AreaSteps {
 public:
  AreaSteps(double area, std::uint64_t points, Random& random)
      : perArea_(area > 0.0 ? static_cast<double>(points) / area : 0.0), points_(points) {
    const double offset = random.next();
    passed_ = 1.0 - offset;
  }

  // How many points the next triangle gets.
  std::uint64_t pass(double area) {
    passed_ += area * perArea_;
    const auto due = static_cast<std::uint64_t>(passed_);
    const std::uint64_t now = due < points_ ? due : points_;
    const std::uint64_t count = now - taken_;
    taken_ = now;
    return count;
  }

 private:
  double perArea_;
  std::uint64_t points_;
  double passed_ = 0.0;  // marks
  std::uint64_t taken_ = 0;
};

}  // namespace hlodbench
