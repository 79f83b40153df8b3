#include "hlod/build/octree.h"

#include <algorithm>

namespace hlodbench {
namespace {

// Appends the children of nodes[id]; they are the full octants of the first cut that parts it.
void splitNode(std::vector<OctreeNode>& nodes, NodeId id, std::span<const std::uint64_t> codes) {
  const std::uint32_t begin = nodes[id].begin;
  const std::uint32_t end = nodes[id].end;
  const unsigned depth = commonDepth(codes[begin], codes[end - 1]);
  if (depth == kMaxOctreeDepth) return;
  nodes[id].firstChild = static_cast<NodeId>(nodes.size());
  for (std::uint32_t childBegin = begin; childBegin < end;) {
    const std::uint64_t cell = cellAt(codes[childBegin], depth + 1);
    const auto childEnd =
        std::partition_point(codes.begin() + childBegin, codes.begin() + end,
                             [&](std::uint64_t code) { return cellAt(code, depth + 1) == cell; });
    OctreeNode child;
    child.begin = childBegin;
    child.end = static_cast<std::uint32_t>(childEnd - codes.begin());
    child.triangles = child.end - child.begin;
    child.level = nodes[id].level + 1;
    childBegin = child.end;
    nodes.push_back(child);
    ++nodes[id].childCount;
  }
}

}  // namespace

std::vector<OctreeNode> computeOctree(std::span<const std::uint64_t> codes,
                                      std::uint32_t maxTriangles) {
  std::vector<OctreeNode> nodes(1);
  nodes[0].end = static_cast<std::uint32_t>(codes.size());
  nodes[0].triangles = codes.size();
  for (NodeId id = 0; id < nodes.size(); ++id)
    if (nodes[id].triangles > maxTriangles) splitNode(nodes, id, codes);
  return nodes;
}

}  // namespace hlodbench
