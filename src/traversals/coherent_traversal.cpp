// This work is based on:
// J. P. Charalambos, J. Bittner, M. Wimmer, E. Romero. Optimized HLOD Refinement Driven by Hardware
// Occlusion Queries. ISVC 2007. Section 4.1, Fig. 2.
#include "traversals/coherent_traversal.h"

namespace hlodbench {

CoherentTraversal::CoherentTraversal(const Hierarchy& hierarchy, const TraversalOptions& options,
                                     Modulation modulation, std::unique_ptr<Predictor> predictor)
    : HierarchyTraversal(hierarchy, options, modulation), predictor_(std::move(predictor)) {}

void CoherentTraversal::doFrame() {
  predictor_->beginFrame(view());
  push(kRoot);
  while (!isQueueEmpty() || !queryQueue_.empty()) {
    // part 1: results that are there; with no node left to go on with, wait for the next one
    while (!queryQueue_.empty() &&
           (isQueueEmpty() || services().isAvailable(queryQueue_.front()))) {
      const NodeId node = queryQueue_.front();
      queryQueue_.pop();
      finish(node);
    }
    // part 2: the nearest node
    if (!isQueueEmpty()) visit(popNearest());
  }
}

void CoherentTraversal::finish(NodeId node) {
  const bool isVisible = finishQuery(node);
  predictor_->onResult(node, view());
  if (!isVisible) return;  // culled, or drawn in vain on a wrong Stop
  traverse(node);          // a RARN if the node was drawn on a Stop and has to be refined after all
}

void CoherentTraversal::visit(NodeId node) {
  if (!isInsideViewFrustum(node)) return;
  // before the node's visible and lastVisited of the last frame are overwritten
  Prediction prediction = predictor_->predict(node, view());
  // a leaf has nothing to refine into
  if (prediction == Prediction::kRefine && view().node(node).isLeaf())
    prediction = Prediction::kStop;
  beginVisit(node, prediction);
  if (prediction == Prediction::kRefine) {
    traverse(node);
    return;
  }
  if (isNear(node)) {
    decideNear(node);  // no box to query: seen at once, nothing to predict
    return;
  }
  issueQuery(node);
  queryQueue_.push(node);
  if (prediction == Prediction::kStop) traverse(node);
}

}  // namespace hlodbench
