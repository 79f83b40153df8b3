#include "hlod/tree/hierarchy.h"

#include <fmt/format.h>

#include <cmath>

#include "hlod/core/error.h"
#include "hlod/tree/hasher.h"

namespace hlodbench {
namespace {

std::string checkLinks(const Hierarchy& h, NodeId id) {
  const Node& node = h.nodes[id];
  if ((id == kRoot) != (node.parent == kNoNode))
    return fmt::format("node {}: only the root has no parent", id);
  if (id != kRoot) {
    if (node.parent >= id) return fmt::format("node {}: stands before its parent", id);
    const Node& parent = h.nodes[node.parent];
    if (id < parent.firstChild || id - parent.firstChild >= parent.childCount)
      return fmt::format("node {}: is not a child of its parent {}", id, node.parent);
    if (node.level != parent.level + 1)
      return fmt::format("node {}: level {} under a parent of level {}", id, node.level,
                         parent.level);
    if (node.level < h.nodes[id - 1].level)
      return fmt::format("node {}: not in breadth-first order", id);
  } else if (node.level != 0) {
    return fmt::format("node {}: the root has level {}", id, node.level);
  }
  if (node.childCount > 8) return fmt::format("node {}: has {} children", id, node.childCount);
  if (node.isLeaf()) {
    if (node.firstChild != kNoNode) return fmt::format("node {}: a leaf with a first child", id);
    return {};
  }
  if (node.firstChild <= id || node.firstChild >= h.nodes.size() ||
      h.nodes.size() - node.firstChild < node.childCount)
    return fmt::format("node {}: children out of range", id);
  for (const Node& child : h.children(node))
    if (child.parent != id)
      return fmt::format("node {}: is not the parent of its child {}", id,
                         static_cast<std::size_t>(&child - h.nodes.data()));
  return {};
}

std::string checkBounds(const Hierarchy& h, NodeId id) {
  const Node& node = h.nodes[id];
  if (!std::isfinite(node.error) || node.error < 0.0f)
    return fmt::format("node {}: error {} is no distance", id, node.error);
  if (node.isLeaf() && node.error != 0.0f)
    return fmt::format("node {}: a leaf with error {}", id, node.error);
  if (node.box.empty()) return fmt::format("node {}: an empty box", id);
  if (id != kRoot) {
    const Node& parent = h.nodes[node.parent];
    if (!parent.box.contains(node.box))
      return fmt::format("node {}: box not within its parent's", id);
    if (parent.error < node.error)
      return fmt::format("node {}: error {} above its parent's {}", id, node.error, parent.error);
  }
  return {};
}

std::string checkGeometry(const Hierarchy& h, NodeId id) {
  const Node& node = h.nodes[id];
  if (node.indexCount == 0 || node.indexCount % 3 != 0)
    return fmt::format("node {}: {} indices make no triangles", id, node.indexCount);
  if (!isGeometryInRange(h, node)) return fmt::format("node {}: geometry out of range", id);
  if (computeHash(h.geometryBytes(node)) != node.geometryHash)
    return fmt::format("node {}: the checksum of its geometry does not match", id);
  const NodeIndices indices = h.indices(node);
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (indices[i] >= node.vertexCount)
      return fmt::format("node {}: index {} is not below its {} vertices", id, indices[i],
                         node.vertexCount);
  std::size_t v = 0;
  for (const Vertex& vertex : h.vertices(node)) {
    const glm::vec3& p = vertex.position;
    const bool inside = glm::all(glm::lessThanEqual(node.box.min, p)) &&
                        glm::all(glm::lessThanEqual(p, node.box.max));
    if (!inside) return fmt::format("node {}: vertex {} outside its box", id, v);
    if (vertex.object >= h.objects.size())
      return fmt::format("node {}: vertex {} of object {}, of {}", id, v, vertex.object,
                         h.objects.size());
    ++v;
  }
  return {};
}

}  // namespace

bool isGeometryInRange(const Hierarchy& hierarchy, const Node& node) {
  const std::uint64_t size = hierarchy.geometry.bytes().size();
  return node.geometryOffset % kBlockAlignment == 0 && node.geometryOffset <= size &&
         size - node.geometryOffset >= node.blockBytes();
}

void checkGeometryHash(const Hierarchy& hierarchy, NodeId id) {
  const Node& node = hierarchy.node(id);
  if (computeHash(hierarchy.geometryBytes(node)) != node.geometryHash)
    throw InputError(
        fmt::format("{}: node {}: damaged: the checksum of its geometry does not match",
                    hierarchy.geometry.name(), id));
}

std::string validate(const Hierarchy& hierarchy) {
  if (hierarchy.nodes.empty()) return "no node at all";
  std::uint64_t leafTriangles = 0;
  for (NodeId id = 0; id < hierarchy.nodes.size(); ++id) {
    for (const auto check : {checkLinks, checkBounds, checkGeometry})
      if (std::string problem = check(hierarchy, id); !problem.empty()) return problem;
    const Node& node = hierarchy.nodes[id];
    if (node.isLeaf()) leafTriangles += node.triangleCount();
  }
  if (leafTriangles != hierarchy.inputTriangles)
    return fmt::format("node {}: the leaves hold {} triangles, the scene {}", kRoot, leafTriangles,
                       hierarchy.inputTriangles);
  return {};
}

}  // namespace hlodbench
