#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace hlodbench {

// A triangle list taken apart until it is manifold and evenly oriented: no edge has more than two
// faces, the faces around each vertex are one fan, and neighbours agree on their winding.
struct ManifoldParts {
  std::vector<glm::uvec3> triangles;  // one a given triangle, same order, over the new vertices
  std::vector<std::uint32_t> source;  // one a new vertex: the given vertex it is a copy of
  std::vector<std::uint8_t> flipped;  // one a triangle: 1 when its winding was reversed
};

// triangles: three different corners each, no triangle twice. Faces across an edge of more than
// two are joined in pairs that agree on the winding; what has no partner gets an edge of its own.
// No triangle is lost.
ManifoldParts computeManifoldParts(std::span<const glm::uvec3> triangles);

}  // namespace hlodbench
