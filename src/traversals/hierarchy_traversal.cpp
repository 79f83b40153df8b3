#include "traversals/hierarchy_traversal.h"

#include <algorithm>

#include "hlod/view/projected_area.h"

namespace hlodbench {

HierarchyTraversal::HierarchyTraversal(const Hierarchy& hierarchy, const TraversalOptions& options,
                                       Modulation modulation)
    : options_(options),
      modulation_(modulation),
      context_{hierarchy, options_, std::vector<NodeState>(hierarchy.nodes.size())},
      frustum_(Camera{}) {}

void HierarchyTraversal::renderFrame(const Camera& camera, FrameServices& services,
                                     FrameRecord& record, Trace* trace) {
  ++context_.frame;
  context_.camera = &camera;
  frustum_ = Frustum(camera);
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
  if (context_.frame > 0)
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
  priorityQueue_.emplace(computeDistance(*context_.camera, context_.hierarchy.node(node).box),
                         node);
}

void HierarchyTraversal::pushChildren(NodeId id) {
  const Node& node = context_.hierarchy.node(id);
  for (std::uint32_t i = 0; i < node.childCount; ++i) push(node.firstChild + i);
}

NodeId HierarchyTraversal::popNearest() {
  const NodeId node = priorityQueue_.top().second;
  priorityQueue_.pop();
  ++counts_.visited;
  return node;
}

bool HierarchyTraversal::isInsideViewFrustum(NodeId node) {
  if (frustum_.intersects(context_.hierarchy.node(node).box)) return true;
  note({TraceEvent::Type::kVisit, node});
  return false;
}

void HierarchyTraversal::beginVisit(NodeId node, Prediction prediction) {
  NodeState& s = state(node);
  s.stoppedBefore =
      context_.wasVisible(node) ? std::optional<bool>(s.stopRefinement) : std::nullopt;
  s.visible = false;
  s.lastVisited = context_.frame;
  s.stopRefinement = prediction != Prediction::kRefine;
  s.delayed = prediction == Prediction::kDelay;
  if (s.delayed) ++counts_.delays;
  if (trace_ != nullptr)
    note({.type = TraceEvent::Type::kVisit,
          .node = node,
          .inFrustum = true,
          .prediction = prediction,
          .sse = context_.computeSse(node)});
}

bool HierarchyTraversal::isNear(NodeId node) const {
  const Aabb& box = context_.hierarchy.node(node).box;
  if (options_.nearPlane == NearPlane::kQuery)
    return computeDistance(*context_.camera, box) <= 0.0;  // from inside, no front face is seen
  return isCutByNearPlane(*context_.camera, box);
}

double HierarchyTraversal::computeBoxPixels(NodeId node) const {
  const Camera& camera = *context_.camera;
  const Aabb& box = context_.hierarchy.node(node).box;
  double area = 0.0;
  // a cut box has no bounds but those of the viewport
  if (options_.nearPlane == NearPlane::kQuery && isCutByNearPlane(camera, box))
    area = computeProjectedAreaOfCutBox(camera, box);
  else
    area = options_.muArea == MuArea::kUnclipped ? computeUnclippedArea(camera, box)
                                                 : computeProjectedArea(camera, box);
  // the rasteriser and the analytic area may differ along the outline: a box under a pixel counts
  // as one, and mu is clamped
  return std::max(1.0, area);
}

void HierarchyTraversal::decideNear(NodeId node) {
  note({TraceEvent::Type::kNear, node});
  pullUpVisibility(node);
  state(node).bias = 1.0;  // B(1)
  state(node).stopRefinement = isWithinTolerance(node);
  noteRepeatedDelay(state(node));
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
  const double boxPixels = computeBoxPixels(node);
  const double mu = std::min(1.0, pixels / boxPixels);
  const bool isDrawnAlready = s.stopRefinement && !s.delayed;  // predicted Stop
  if (pixels > 0) {
    pullUpVisibility(node);
    s.bias = modulation_ == Modulation::kBias ? computeBias(mu, options_.bias) : 1.0;
    s.stopRefinement = isWithinTolerance(node);
    if (isDrawnAlready && s.stopRefinement) ++counts_.queriesWasted;
    noteRepeatedDelay(s);
  } else if (options_.zeroPixels == ZeroPixels::kZeroBias) {
    // deviation: Fig. 2 leaves the old bias in place; see docs/deviations.md
    s.bias = modulation_ == Modulation::kBias ? computeBias(0.0, options_.bias) : 1.0;
  }
  note({.type = TraceEvent::Type::kResult,
        .node = node,
        .pixels = pixels,
        .boxPixels = boxPixels,
        .mu = mu,
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
  if (s.lastRendered == context_.frame) {
    ++counts_.refinedAfterRender;
    note({TraceEvent::Type::kRarn, node});
  }
  pushChildren(node);
}

void HierarchyTraversal::render(NodeId node) {
  NodeState& s = state(node);
  // a node drawn on a Stop whose result confirms it comes here again; Fig. 2 leaves out this guard,
  // which the demo program of Bittner et al. has
  if (s.lastRendered == context_.frame && options_.renderGuard == RenderGuard::kOn) return;
  if (s.lastRendered == context_.frame - 1) ++counts_.drawnAgain;
  s.lastRendered = context_.frame;
  ++counts_.drawn;
  if (s.delayed) ++counts_.delayedDrawn;
  counts_.triangles += context_.hierarchy.node(node).triangleCount();
  note({TraceEvent::Type::kDraw, node});
  services_->draw(node);
}

void HierarchyTraversal::pullUpVisibility(NodeId node) {
  while (node != kNoNode && !state(node).visible) {
    state(node).visible = true;
    node = context_.hierarchy.node(node).parent;
  }
}

bool HierarchyTraversal::isWithinTolerance(NodeId node) const {
  // a leaf has no error and nothing to refine into: it always stops
  return context_.hierarchy.node(node).isLeaf() ||
         context_.states[node].bias * context_.computeSse(node) <= options_.tau;
}

}  // namespace hlodbench
