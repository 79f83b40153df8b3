#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

namespace hlodbench {

// Whether a mesh is taken for one part, for the memory it would take to know better.
constexpr bool isTooLargeForParts(std::uint64_t vertices, std::uint64_t triangles) {
  constexpr std::uint64_t kMostTriangles = 4'000'000;
  return triangles > kMostTriangles || vertices > 3 * kMostTriangles;
}

// The mean number of triangles of a mesh's connected parts. Triangles are connected where they have
// a corner at exactly the same place. A scan is one part or few, a machine or a building many: no
// simplifier joins parts, so that large nodes of many of them become coarse or stay full.
// Positions must be finite and indices in range; 0 without triangles.
double computeMeanPartSize(std::span<const glm::vec3> positions,
                           std::span<const glm::uvec3> triangles);

}  // namespace hlodbench
