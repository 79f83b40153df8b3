#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hlod/build/cell_codes.h"
#include "hlod/core/aabb.h"
#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// A cell of the octree, with the pieces of its own range: triangles sorted by their codes, or, in
// the top of a large tree, chunks.
struct OctreeNode {
  std::uint32_t begin = 0;  // its subtree's pieces: [begin, end)
  std::uint32_t end = 0;
  std::uint64_t triangles = 0;  // of the scene in its subtree
  Aabb box;                     // tight over the vertices of those triangles, world units
  NodeId firstChild = kNoNode;
  std::uint32_t childCount = 0;  // 0, or 2 to 8
  std::uint32_t level = 0;       // 0 for the root; counts nodes, not cell subdivisions
  [[nodiscard]] bool isLeaf() const { return childCount == 0; }
};

// Builds an octree over triangles' centroids: a cell is cut while it holds more than maxTriangles.
// Empty octants make no node, and a cell with a single full octant is cut further without making
// one. codes: of the triangles, in increasing order. Nodes come in breadth-first order, the root
// first, children neighbours; their boxes are empty.
std::vector<OctreeNode> computeOctree(std::span<const std::uint64_t> codes,
                                      std::uint32_t maxTriangles);

}  // namespace hlodbench
