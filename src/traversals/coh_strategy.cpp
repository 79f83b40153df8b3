// This work is based on:
// J. P. Charalambos, J. Bittner, M. Wimmer, E. Romero. Optimized HLOD Refinement Driven by Hardware
// Occlusion Queries. ISVC 2007. Section 4.2, Fig. 3.
#include <optional>

#include "traversals/coherent_traversal.h"
#include "traversals/strategies.h"

namespace hlodbench {
namespace {

// Fig. 3, PredictRefinement(node); the comments quote it line by line.
class CohPredictor final : public Predictor {
 public:
  explicit CohPredictor(const TraversalOptions& options)
      : staleChildren_(options.staleChildren), pullUp_(options.pullUp) {}

  Prediction predict(NodeId id, const FrameView& view) override {
    const NodeState& node = view.state(id);
    const double tau = view.tau();
    // if not (node.lastVisited = frameID-1) or node.visible = false then return Delay
    if (!view.wasVisible(id)) return Prediction::kDelay;
    // if not node.stopRefinement then
    if (!node.stopRefinement) {
      const Children children = lookAtChildren(id, view);
      if (children.oneGoesOn && pullUp_ == PullUp::kDelay) return Prediction::kDelay;
      // if candidateToShiftUp then if AvgBias(node.children)*CalcSSE(node) <= tau return Delay
      if (children.averageBias && *children.averageBias * view.computeSse(id) <= tau)
        return Prediction::kDelay;
    } else if (node.bias * view.computeSse(id) <= tau) {
      // else if node.bias*CalcSSE(node) <= tau then return Stop
      return Prediction::kStop;
    }
    // return Refine
    return Prediction::kRefine;
  }

 private:
  struct Children {
    // refinement did not stop at one of them or, estimated by Eq. 2, would not stop there again
    bool oneGoesOn = false;
    // AvgBias(node.children) when the node is a candidate for pulling up the front of termination
    // nodes; nothing when it is not
    std::optional<double> averageBias;
  };

  [[nodiscard]] Children lookAtChildren(NodeId id, const FrameView& view) const {
    const plugin::Node& node = view.node(id);
    double sum = 0.0;
    int count = 0;
    // forall child in node.children do
    for (NodeId c = node.firstChild; c < node.firstChild + node.childCount; ++c) {
      const NodeState& child = view.state(c);
      // deviation: Fig. 3 also asks children that were outside the frustum and so keep the values
      // of some earlier frame; see docs/deviations.md
      if (staleChildren_ == StaleChildren::kSkip && child.lastVisited != view.frame() - 1) continue;
      // if not child.stopRefinement or not (child.bias*CalcSSE(child) <= tau)
      //   candidateToShiftUp <- false
      if (!child.stopRefinement || child.bias * view.computeSse(c) > view.tau()) return {true, {}};
      sum += child.bias;
      ++count;
    }
    // with no child seen in the last frame there is nothing to average: not a candidate
    if (count == 0) return {};
    return {false, sum / count};
  }

  StaleChildren staleChildren_;
  PullUp pullUp_;
};

}  // namespace

std::unique_ptr<Strategy> makeCohStrategy(const StrategyInputs& inputs) {
  return std::make_unique<CoherentTraversal>(inputs.hierarchy, inputs.options, Modulation::kBias,
                                             std::make_unique<CohPredictor>(inputs.options));
}

}  // namespace hlodbench
