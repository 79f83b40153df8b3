#pragma once

#include <optional>
#include <vector>

#include "hlod/tree/hierarchy.h"
#include "hlod/view/screen_error.h"
#include "traversals/options.h"

namespace hlodbench {

// What a traversal remembers of a node from frame to frame (paper, Figs. 2 and 3).
struct NodeState {
  double bias = 1.0;            // cached B(mu) of the last result
  int lastVisited = -1;         // frame in which the node was last taken up inside the frustum
  int lastRendered = -1;        // frame in which it was last drawn
  bool visible = false;         // some pixel of it, or below it, was seen in frame lastVisited
  bool stopRefinement = false;  // the front ended here in frame lastVisited
  bool delayed = false;         // predicted Delay in frame lastVisited
  // stopRefinement of the frame before lastVisited, where the node was visible in it
  std::optional<bool> stoppedBefore;
};

// What a prediction may be based on: the hierarchy, the last frame's states, this frame's camera.
struct PredictionContext {
  const Hierarchy& hierarchy;
  const TraversalOptions& options;
  std::vector<NodeState> states;  // one a node
  int frame = -1;                 // frameID of the paper; the first frame is 0
  const Camera* camera = nullptr;

  [[nodiscard]] double computeSse(NodeId id) const {
    const Node& node = hierarchy.node(id);
    return computeScreenError(*camera, node.box, node.error);
  }
  // "visible" refers to the last frame until the node is taken up in this one.
  [[nodiscard]] bool wasVisible(NodeId id) const {
    return states[id].lastVisited == frame - 1 && states[id].visible;
  }
};

}  // namespace hlodbench
