#pragma once

#include <optional>
#include <queue>
#include <utility>
#include <vector>

#include "traversals/predictor.h"
#include "traversals/scene_view.h"
#include "traversals/strategy.h"

namespace hlodbench {

// What every traversal of the HLOD hierarchy shares: the priority queue, the operations that the
// pseudocode names, counters and the trace. A subclass writes only its frame algorithm.
class HierarchyTraversal : public Strategy {
 public:
  HierarchyTraversal(const Hierarchy& hierarchy, const TraversalOptions& options,
                     Modulation modulation);

  void renderFrame(const Camera& camera, FrameServices& services, FrameRecord& record,
                   Trace* trace) final;

  // What is remembered of each node, for tests and overlays.
  [[nodiscard]] const std::vector<NodeState>& states() const { return scene_.states(); }

 protected:
  // One frame, from an empty priority queue to an empty one.
  virtual void doFrame() = 0;

  // The priority queue: nearest first, equal distances by node id.
  void push(NodeId node);
  void pushChildren(NodeId node);
  NodeId popNearest();
  [[nodiscard]] bool isQueueEmpty() const { return priorityQueue_.empty(); }

  // InsideViewFrustum; notes the visit when it is outside.
  bool isInsideViewFrustum(NodeId node);
  // Notes that a node inside the frustum is taken up in this frame with this prediction.
  void beginVisit(NodeId node, Prediction prediction);
  // True when no query can be issued for the node; it counts as wholly visible then.
  [[nodiscard]] bool isNear(NodeId node) const;
  // Decides a near node at once: visible, mu = 1.
  void decideNear(NodeId node);
  void issueQuery(NodeId node);
  // Waits for the result, stores bias and stopRefinement; false when no pixel passed.
  bool finishQuery(NodeId node);
  // Fig. 2, Traverse(): draws the node if refinement stops there, else pushes its children.
  void traverse(NodeId node);
  // Marks the node and all above it as visible.
  void pullUpVisibility(NodeId node);
  // Whether the error, modulated by the node's bias, is small enough to draw it; true for a leaf.
  [[nodiscard]] bool isWithinTolerance(NodeId node) const;

  [[nodiscard]] NodeState& state(NodeId node) { return scene_.state(node); }
  [[nodiscard]] FrameServices& services() { return *services_; }
  [[nodiscard]] const FrameView& view() const { return scene_.frame(); }

 private:
  using Entry = std::pair<double, NodeId>;  // distance, then id: a total order

  struct Counts {
    int drawn = 0, refinedAfterRender = 0, delayedDrawn = 0, delays = 0, queries = 0, visited = 0;
    int queriesWasted = 0, repeatedDelays = 0;
    int drawnAgain = 0;  // of drawn: in the last frame, too
    std::uint64_t triangles = 0;
  };

  // A traversal without queries has none of the counters about them.
  [[nodiscard]] virtual bool asksQueries() const { return true; }

  void render(NodeId node);
  // Counts a delay that the last frame's decision would have spared.
  void noteRepeatedDelay(NodeId node) {
    const NodeState& s = state(node);
    if (s.delayed && stoppedBefore_[node] == s.stopRefinement) ++counts_.repeatedDelays;
  }
  void storeCounts(FrameRecord& record) const;
  void note(const TraceEvent& event) {
    if (trace_ != nullptr) trace_->push_back(event);
  }

  TraversalOptions options_;
  Modulation modulation_;
  SceneView scene_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> priorityQueue_;
  FrameServices* services_ = nullptr;
  Trace* trace_ = nullptr;
  Counts counts_;
  // by node: stopRefinement of the frame before lastVisited, where the node was visible in it
  std::vector<std::optional<bool>> stoppedBefore_;
  int drawnInLastFrame_ = 0;
};

}  // namespace hlodbench
