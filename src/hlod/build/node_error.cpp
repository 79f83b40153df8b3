#include "hlod/build/node_error.h"

#include <algorithm>
#include <cmath>

#include "hlod/build/node_frame.h"
#include "hlod/build/surface_distance.h"

namespace hlodbench {
namespace {

// SplitMix64 (Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  // In [0, 1).
  double next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

struct Corners {
  glm::dvec3 a, b, c;
  [[nodiscard]] double area() const { return 0.5 * glm::length(glm::cross(b - a, c - a)); }
};

Corners cornersOf(const WeldedMesh& mesh, const glm::uvec3& t) {
  return {mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]};
}

glm::dvec3 randomPoint(const Corners& t, Random& random) {
  double u = random.next();
  double v = random.next();
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return t.a + (t.b - t.a) * u + (t.c - t.a) * v;
}

SurfaceDistance computeSurface(const WeldedMesh& mesh, const NodeFrame& frame,
                               std::span<const glm::uvec3> lod) {
  std::vector<glm::vec3> corners;
  corners.reserve(lod.size() * 3);
  for (const glm::uvec3& t : lod)
    for (int corner = 0; corner < 3; ++corner)
      corners.push_back(frame.toLocal(mesh.positions[t[corner]]));
  return SurfaceDistance(corners);
}

// What rounding can add to a distance when somebody else measures it: a few units in the last
// place of the largest coordinate.
float roundingOf(const Aabb& box) {
  const glm::vec3 largest = glm::max(glm::abs(box.min), glm::abs(box.max));
  return 4e-7f * std::max({largest.x, largest.y, largest.z});
}

}  // namespace

float computeNodeError(const WeldedMesh& mesh, const BorderLocks& locks, const OctreeNode& node,
                       std::span<const glm::uvec3> lod, std::uint32_t faceSamples,
                       float childError) {
  const NodeFrame frame(node.box);
  const SurfaceDistance surface = computeSurface(mesh, frame, lod);
  double area = 0.0;
  for (std::uint32_t i = node.begin; i < node.end; ++i)
    area += cornersOf(mesh, mesh.triangles[i]).area();

  // Only the maximum is wanted, so a query may stop as soon as it is known not to raise it.
  const float childLocal = static_cast<float>(childError / frame.unit());
  float largest = childLocal * childLocal;
  const float start = largest;
  std::uint32_t hint = 0;
  const auto measure = [&](const glm::dvec3& point) {
    largest = std::max(largest, surface.distanceSquared(frame.toLocal(point), largest, hint));
  };
  Random random(std::uint64_t{node.begin} << 32 | node.end);
  const double step = area / std::max(faceSamples, 1u);
  double passed = 0.0;
  double nextSample = faceSamples > 0 ? random.next() * step : area;
  std::uint64_t taken = 0;
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    for (int corner = 0; corner < 3; ++corner)
      if (locks.firstTriangle(t[corner]) == i) measure(mesh.positions[t[corner]]);
    const Corners corners = cornersOf(mesh, t);
    passed += corners.area();
    // One sample in every equal share of the area, at a random place in it.
    while (taken < faceSamples && nextSample < passed) {
      measure(randomPoint(corners, random));
      ++taken;
      nextSample = (static_cast<double>(taken) + random.next()) * step;
    }
  }
  if (largest <= start) return childError;
  const double measured = std::sqrt(static_cast<double>(largest)) * frame.unit();
  return std::max(childError, static_cast<float>(measured * (1.0 + 1e-4)) + roundingOf(node.box));
}

}  // namespace hlodbench
