// This work is based on:
// J. Bittner, M. Wimmer, H. Piringer, W. Purgathofer. Coherent Hierarchical Culling: Hardware
//   Occlusion Queries Made Useful. CGF 23(3), 2004: hierarchical stop-and-wait.
// J. P. Charalambos et al. ISVC 2007, section 4.1: the "naive algorithm", and section 5.1, SW(B).
#include "traversals/hierarchy_traversal.h"
#include "traversals/strategies.h"

namespace hlodbench {
namespace {

// Queries every node, waits for the result, decides.
class StopAndWaitTraversal final : public HierarchyTraversal {
 public:
  using HierarchyTraversal::HierarchyTraversal;

 private:
  void doFrame() override {
    push(kRoot);
    while (!isQueueEmpty()) visit(popNearest());
  }

  void visit(NodeId node) {
    if (!isInsideViewFrustum(node)) return;
    beginVisit(node, Prediction::kDelay);
    if (isNear(node)) {
      decideNear(node);
      return;
    }
    issueQuery(node);
    if (finishQuery(node)) traverse(node);
  }
};

}  // namespace

std::unique_ptr<Strategy> makeStopAndWaitStrategy(const StrategyInputs& inputs) {
  return std::make_unique<StopAndWaitTraversal>(inputs.hierarchy, inputs.options,
                                                Modulation::kBias);
}

}  // namespace hlodbench
