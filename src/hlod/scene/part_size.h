#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

namespace hlodbench {

inline constexpr std::uint64_t kMostExaminedTriangles = 4'000'000;

// The mean number of triangles of a mesh's connected parts. Triangles are connected where they have
// a corner at exactly the same place. A scan is one part or few, a machine or a building many: no
// simplifier joins parts, so that large nodes of many of them become coarse or stay full.
// A mesh of more than kMostExaminedTriangles is taken for one part, for the memory it would take to
// know.
// Indices must be in range; 0 without triangles.
double computeMeanPartSize(std::span<const glm::vec3> positions,
                           std::span<const glm::uvec3> triangles);

}  // namespace hlodbench
