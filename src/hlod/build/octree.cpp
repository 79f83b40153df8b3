#include "hlod/build/octree.h"

#include <algorithm>
#include <bit>

namespace hlodbench {
namespace {

// The path from the root cell to the deepest cell of a centroid: 3 bits a cut, the first on top.
struct CellPath {
  std::uint64_t code;
  std::uint32_t triangle;
};

std::uint64_t spreadBits(std::uint32_t value) {
  std::uint64_t x = value & 0x1fffffu;
  x = (x | x << 32) & 0x1f00000000ffffu;
  x = (x | x << 16) & 0x1f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  x = (x | x << 2) & 0x1249249249249249u;
  return x;
}

std::vector<CellPath> computeCellPaths(const WeldedMesh& mesh) {
  const glm::dvec3 low(mesh.box.min);
  const glm::dvec3 high(mesh.box.max);
  const glm::dvec3 extent = high - low;
  const double size = std::max({extent.x, extent.y, extent.z});
  const glm::dvec3 corner = (low + high) * 0.5 - size * 0.5;
  constexpr double kCells = 1u << kMaxOctreeDepth;
  const double scale = kCells / size;
  std::vector<CellPath> paths(mesh.triangles.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::dvec3 centroid = (glm::dvec3(mesh.positions[t.x]) + glm::dvec3(mesh.positions[t.y]) +
                                 glm::dvec3(mesh.positions[t.z])) /
                                3.0;
    const glm::dvec3 cell = glm::clamp((centroid - corner) * scale, 0.0, kCells - 1.0);
    paths[i].code = spreadBits(static_cast<std::uint32_t>(cell.x)) << 2 |
                    spreadBits(static_cast<std::uint32_t>(cell.y)) << 1 |
                    spreadBits(static_cast<std::uint32_t>(cell.z));
    paths[i].triangle = static_cast<std::uint32_t>(i);
  }
  return paths;
}

// The number of cuts after which two paths part; kMaxOctreeDepth when they are the same.
unsigned commonDepth(std::uint64_t a, std::uint64_t b) {
  if (a == b) return kMaxOctreeDepth;
  const unsigned highestBit = 63u - static_cast<unsigned>(std::countl_zero(a ^ b));
  return kMaxOctreeDepth - 1 - highestBit / 3;
}

// Appends the children of nodes[id]; they are the full octants of the first cut that parts it.
void splitNode(std::vector<OctreeNode>& nodes, NodeId id, const std::vector<CellPath>& paths) {
  const std::uint32_t begin = nodes[id].begin;
  const std::uint32_t end = nodes[id].end;
  const unsigned depth = commonDepth(paths[begin].code, paths[end - 1].code);
  if (depth == kMaxOctreeDepth) return;
  const unsigned shift = 3 * (kMaxOctreeDepth - 1 - depth);
  nodes[id].firstChild = static_cast<NodeId>(nodes.size());
  for (std::uint32_t childBegin = begin; childBegin < end;) {
    const std::uint64_t prefix = paths[childBegin].code >> shift;
    const auto childEnd =
        std::partition_point(paths.begin() + childBegin, paths.begin() + end,
                             [&](const CellPath& path) { return (path.code >> shift) == prefix; });
    OctreeNode child;
    child.begin = childBegin;
    child.end = static_cast<std::uint32_t>(childEnd - paths.begin());
    child.parent = id;
    child.level = nodes[id].level + 1;
    childBegin = child.end;
    nodes.push_back(child);
    ++nodes[id].childCount;
  }
}

void computeBoxes(std::vector<OctreeNode>& nodes, const WeldedMesh& mesh) {
  for (std::size_t i = nodes.size(); i-- > 0;) {
    OctreeNode& node = nodes[i];
    if (node.isLeaf()) {
      for (std::uint32_t t = node.begin; t < node.end; ++t)
        for (int corner = 0; corner < 3; ++corner)
          node.box.extend(mesh.positions[mesh.triangles[t][corner]]);
    } else {
      for (std::uint32_t child = 0; child < node.childCount; ++child)
        node.box.extend(nodes[node.firstChild + child].box);
    }
  }
}

}  // namespace

Octree computeOctree(WeldedMesh& mesh, std::uint32_t maxTriangles) {
  std::vector<CellPath> paths = computeCellPaths(mesh);
  // The triangle's number settles ties, so that the order is the same everywhere.
  std::sort(paths.begin(), paths.end(), [](const CellPath& a, const CellPath& b) {
    return a.code != b.code ? a.code < b.code : a.triangle < b.triangle;
  });
  {
    std::vector<glm::uvec3> sorted(paths.size());
    for (std::size_t i = 0; i < paths.size(); ++i) sorted[i] = mesh.triangles[paths[i].triangle];
    mesh.triangles = std::move(sorted);
  }
  Octree tree;
  tree.nodes.emplace_back();
  tree.nodes[0].end = static_cast<std::uint32_t>(paths.size());
  for (NodeId id = 0; id < tree.nodes.size(); ++id) {
    const bool tooLarge = tree.nodes[id].size() > maxTriangles;
    if (tooLarge) splitNode(tree.nodes, id, paths);
    const OctreeNode& node = tree.nodes[id];
    tree.levels = node.level + 1;
    if (!node.isLeaf()) continue;
    ++tree.leaves;
    if (tooLarge) ++tree.oversizedLeaves;
  }
  computeBoxes(tree.nodes, mesh);
  return tree;
}

}  // namespace hlodbench
