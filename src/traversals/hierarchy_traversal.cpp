#include "traversals/hierarchy_traversal.h"

namespace hlodbench {

HierarchyTraversal::HierarchyTraversal(const Hierarchy& hierarchy, const TraversalOptions& options,
                                       Modulation modulation)
    : options_(options),
      modulation_(modulation),
      scene_(hierarchy, options),
      stoppedBefore_(hierarchy.nodes.size()) {}

void HierarchyTraversal::renderFrame(const Camera& camera, FrameServices& services,
                                     FrameRecord& record, Trace* trace) {
  scene_.beginFrame(camera);
  services_ = &services;
  trace_ = trace;
  drawnInLastFrame_ = counts_.drawn;
  counts_ = {};
  doFrame();
  storeCounts(record);
}

void HierarchyTraversal::storeCounts(FrameRecord& record) const {
  record.set(Counter::kDn, counts_.drawn);
  record.set(Counter::kTriangles, static_cast<double>(counts_.triangles));
  record.set(Counter::kNodesVisited, counts_.visited);
  if (view().frame() > 0)
    record.set(Counter::kFrontChange, counts_.drawn + drawnInLastFrame_ - 2 * counts_.drawnAgain);
  if (!asksQueries()) return;
  record.set(Counter::kRarn, counts_.refinedAfterRender);
  record.set(Counter::kD, counts_.delayedDrawn);
  record.set(Counter::kDelays, counts_.delays);
  record.set(Counter::kQueries, counts_.queries);
  record.set(Counter::kQueriesWasted, counts_.queriesWasted);
  record.set(Counter::kRepeatedDelays, counts_.repeatedDelays);
}

void HierarchyTraversal::push(NodeId node) {
  priorityQueue_.emplace(view().computeDistance(node), node);
}

void HierarchyTraversal::pushChildren(NodeId id) {
  const plugin::Node& node = view().node(id);
  for (std::uint32_t i = 0; i < node.childCount; ++i) push(node.firstChild + i);
}

NodeId HierarchyTraversal::popNearest() {
  const NodeId node = priorityQueue_.top().second;
  priorityQueue_.pop();
  ++counts_.visited;
  return node;
}

bool HierarchyTraversal::isInsideViewFrustum(NodeId node) {
  if (scene_.isInsideFrustum(node)) return true;
  note({TraceEvent::Type::kVisit, node});
  return false;
}

void HierarchyTraversal::beginVisit(NodeId node, Prediction prediction) {
  NodeState& s = state(node);
  stoppedBefore_[node] =
      view().wasVisible(node) ? std::optional<bool>(s.stopRefinement) : std::nullopt;
  s.visible = false;
  s.lastVisited = view().frame();
  s.stopRefinement = prediction != Prediction::kRefine;
  s.delayed = prediction == Prediction::kDelay;
  if (s.delayed) ++counts_.delays;
  if (trace_ != nullptr)
    note({.type = TraceEvent::Type::kVisit,
          .node = node,
          .inFrustum = true,
          .prediction = prediction,
          .sse = view().computeSse(node)});
}

bool HierarchyTraversal::isNear(NodeId node) const {
  return scene_.isCutByNearPlane(node);
}

void HierarchyTraversal::decideNear(NodeId node) {
  note({TraceEvent::Type::kNear, node});
  pullUpVisibility(node);
  state(node).mu = 1.0;
  state(node).bias = 1.0;  // B(1)
  state(node).stopRefinement = isWithinTolerance(node);
  noteRepeatedDelay(node);
  traverse(node);
}

void HierarchyTraversal::issueQuery(NodeId node) {
  ++counts_.queries;
  note({TraceEvent::Type::kQuery, node});
  services_->issueQuery(node);
}

bool HierarchyTraversal::finishQuery(NodeId node) {
  NodeState& s = state(node);
  const std::uint32_t pixels = services_->getResult(node);
  const double boxPixels = scene_.computeBoxPixels(node);
  scene_.storePixels(node, pixels, boxPixels);
  const bool isDrawnAlready = s.stopRefinement && !s.delayed;  // predicted Stop
  if (pixels > 0) {
    pullUpVisibility(node);
    s.bias = modulation_ == Modulation::kBias ? computeBias(s.mu, options_.bias) : 1.0;
    s.stopRefinement = isWithinTolerance(node);
    if (isDrawnAlready && s.stopRefinement) ++counts_.queriesWasted;
    noteRepeatedDelay(node);
  } else if (options_.zeroPixels == ZeroPixels::kZeroBias) {
    // deviation: Fig. 2 leaves the old bias in place; see docs/deviations.md
    s.bias = modulation_ == Modulation::kBias ? computeBias(0.0, options_.bias) : 1.0;
  }
  note({.type = TraceEvent::Type::kResult,
        .node = node,
        .pixels = pixels,
        .boxPixels = boxPixels,
        .mu = s.mu,
        .bias = s.bias,
        .stop = s.stopRefinement});
  return pixels > 0;
}

void HierarchyTraversal::traverse(NodeId node) {
  const NodeState& s = state(node);
  if (s.stopRefinement) {
    render(node);
    return;
  }
  if (s.lastRendered == view().frame()) {
    ++counts_.refinedAfterRender;
    note({TraceEvent::Type::kRarn, node});
  }
  pushChildren(node);
}

void HierarchyTraversal::render(NodeId node) {
  NodeState& s = state(node);
  // a node drawn on a Stop whose result confirms it comes here again; Fig. 2 leaves out this guard,
  // which the demo program of Bittner et al. has
  if (s.lastRendered == view().frame() && options_.renderGuard == RenderGuard::kOn) return;
  if (s.lastRendered == view().frame() - 1) ++counts_.drawnAgain;
  s.lastRendered = view().frame();
  ++counts_.drawn;
  if (s.delayed) ++counts_.delayedDrawn;
  counts_.triangles += view().node(node).triangleCount;
  note({TraceEvent::Type::kDraw, node});
  services_->draw(node);
}

void HierarchyTraversal::pullUpVisibility(NodeId node) {
  while (node != kNoNode && !state(node).visible) {
    state(node).visible = true;
    node = view().node(node).parent;
  }
}

bool HierarchyTraversal::isWithinTolerance(NodeId node) const {
  // a leaf has no error and nothing to refine into: it always stops
  return view().node(node).isLeaf() ||
         view().state(node).bias * view().computeSse(node) <= options_.tau;
}

}  // namespace hlodbench
