#pragma once

#include <vector>

#include "hlod/tree/hierarchy.h"
#include "hlod/view/frustum.h"
#include "traversals/trace_event.h"

namespace hlodbench {

// A node as a strategy drew it in one frame.
struct DrawnNode {
  NodeId node = kNoNode;
  float bias = 1.0f;     // of its last query result in the frame, 0 to 1; 1 without one
  bool refined = false;  // refined after it was drawn: a RARN
};

// What was drawn in one frame, in order: all that its picture depends on.
struct Front {
  int frame = 0;
  std::vector<DrawnNode> nodes;
};

Front computeFront(int frame, const Trace& events);

// The full-resolution model, as far as it may be seen: leaves whose box meets the frustum, by id.
std::vector<NodeId> listLeavesInside(const Hierarchy& hierarchy, const Frustum& frustum);

}  // namespace hlodbench
