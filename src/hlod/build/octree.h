#pragma once

#include <cstdint>
#include <vector>

#include "hlod/build/welded_mesh.h"
#include "hlod/core/aabb.h"
#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// A cell of the octree that holds triangles of its own range, in the order of the sorted mesh.
struct OctreeNode {
  std::uint32_t begin = 0;  // its subtree's triangles: [begin, end)
  std::uint32_t end = 0;
  Aabb box;  // tight over the vertices of those triangles, world units
  NodeId parent = kNoNode;
  NodeId firstChild = kNoNode;
  std::uint32_t childCount = 0;  // 0, or 2 to 8
  std::uint32_t level = 0;       // 0 for the root; counts nodes, not cell subdivisions
  [[nodiscard]] std::uint32_t size() const { return end - begin; }
  [[nodiscard]] bool isLeaf() const { return childCount == 0; }
};

// Nodes in breadth-first order, the root first, children neighbours: as in Hierarchy.
struct Octree {
  std::vector<OctreeNode> nodes;
  std::uint32_t levels = 0;
  std::uint32_t leaves = 0;
  std::uint32_t oversizedLeaves = 0;  // over the limit, where centroids (nearly) coincide
};

// A cell is cut in 8 no more often than this.
inline constexpr unsigned kMaxOctreeDepth = 20;

// Builds an octree over the triangles' centroids: a cell is cut while it holds more than
// maxTriangles. Empty octants make no node, and a cell with a single full octant is cut further
// without making one. Sorts mesh.triangles so that every subtree is a range of them.
Octree computeOctree(WeldedMesh& mesh, std::uint32_t maxTriangles);

}  // namespace hlodbench
