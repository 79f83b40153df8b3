#pragma once

#include <span>

#include <glm/glm.hpp>

namespace hlodbench {

// The mean number of triangles of a mesh's connected parts. Triangles are connected where they have
// a corner at exactly the same place. A scan is one part or few, a machine or a building many: no
// simplifier joins parts, so that large nodes of many of them become coarse or stay full.
// Indices must be in range; 0 without triangles.
double computeMeanPartSize(std::span<const glm::vec3> positions,
                           std::span<const glm::uvec3> triangles);

}  // namespace hlodbench
