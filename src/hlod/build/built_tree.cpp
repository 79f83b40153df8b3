#include "hlod/build/built_tree.h"

namespace hlodbench {

Hierarchy makeHierarchy(const BuiltTree& tree) {
  Hierarchy out;
  out.objects = tree.objects;
  out.inputTriangles = tree.inputTriangles;
  out.nodes.reserve(tree.nodes.size());
  for (const BuiltNode& from : tree.nodes) {
    Node node;
    node.box = from.box;
    node.error = from.error;
    node.parent = from.parent;
    node.firstChild = from.firstChild;
    node.childCount = from.childCount;
    node.level = from.level;
    node.flags = from.consistentWinding ? kConsistentWinding : 0;
    out.nodes.push_back(node);
  }
  return out;
}

std::vector<NodeId> sinkIds(const BuiltTree& tree) {
  std::vector<NodeId> ids;
  ids.reserve(tree.nodes.size());
  for (const BuiltNode& node : tree.nodes) ids.push_back(node.sinkId);
  return ids;
}

}  // namespace hlodbench
