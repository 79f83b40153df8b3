#pragma once

#include <cstdint>
#include <vector>

#include "hlod/core/aabb.h"
#include "hlod/scene/triangle_mesh.h"
#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// A node of a hierarchy as it was built: all but its geometry, which went to a NodeSink.
struct BuiltNode {
  Aabb box;  // as in Node
  float error = 0.0f;
  NodeId firstChild = kNoNode;
  std::uint32_t childCount = 0;
  NodeId parent = kNoNode;
  std::uint32_t level = 0;
  std::uint32_t vertexCount = 0;
  std::uint32_t indexCount = 0;
  // Every edge of the objects below the node joins at most two triangles, which pass it in opposite
  // directions, and no triangle was turned over by simplification.
  bool consistentWinding = false;
  NodeId sinkId = kNoNode;  // the number under which the sink got its geometry
};

// A hierarchy without its geometry.
struct BuiltTree {
  std::vector<BuiltNode> nodes;  // in the order of Hierarchy::nodes
  std::vector<SceneObject> objects;
  std::uint64_t inputTriangles = 0;
};

// The hierarchy that a sink's finish() completes, with sinkIds() of the same tree.
Hierarchy makeHierarchy(const BuiltTree& tree);
std::vector<NodeId> sinkIds(const BuiltTree& tree);

}  // namespace hlodbench
