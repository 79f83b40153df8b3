#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/core/aabb.h"
#include "hlod/scene/triangle_mesh.h"

namespace hlodbench {

// A triangle soup with equal corners joined: what the hierarchy is built from. A vertex is unique
// by exact position and object; a position id is unique by exact position alone (-0 equals 0).
// Only vertices that a triangle uses are there, numbered in the order of first use.
struct WeldedMesh {
  std::vector<glm::vec3> positions;        // one a vertex
  std::vector<glm::vec3> normals;          // one a vertex: unit length, area-weighted
  std::vector<std::uint32_t> objects;      // one a vertex: index into TriangleMesh::objectTable
  std::vector<std::uint32_t> positionIds;  // one a vertex
  std::vector<std::uint8_t> seams;         // one a position id: 1 where several objects meet
  std::vector<glm::uvec3> triangles;       // as many as in the soup, in its order
  Aabb box;                                // of the used vertices
  [[nodiscard]] std::size_t positionCount() const { return seams.size(); }
};

// Welds a soup. Throws InputError when it has no triangle, no area, a vertex that is not finite,
// an index or an object out of range, or a number of objects that is not the number of triangles.
WeldedMesh computeWeldedMesh(const TriangleMesh& mesh);

}  // namespace hlodbench
