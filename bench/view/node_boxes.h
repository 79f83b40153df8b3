#pragma once

#include <vector>

#include "hlod/tree/hierarchy.h"
#include "traversals/trace_event.h"

namespace hlodbench {

// What became of the nodes of one frame, each list in order of happening and each node once.
struct NodeBoxes {
  std::vector<NodeId> drawn;
  std::vector<NodeId> visible;   // queried; a pixel of the box passed
  std::vector<NodeId> occluded;  // queried; none passed
  std::vector<NodeId> culled;    // outside the frustum
};

// events: of one frame.
NodeBoxes collectBoxes(const Trace& events);

}  // namespace hlodbench
