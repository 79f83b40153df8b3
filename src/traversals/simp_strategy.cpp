// This work is based on:
// J. P. Charalambos. Coherent Hierarchical Level-of-Detail (HLOD) Refinement through Hardware
//   Occlusion Queries. SIACG 2006 (abstract only: the method's body was not to be had).
// J. P. Charalambos et al. ISVC 2007, sections 2, 3.1 and 5.2: what it says of that method.
// reconstruction: a current-frame estimate from the processing order of the nodes; it is not known
// to be the authors' rule. See docs/deviations.md.
#include "traversals/coherent_traversal.h"
#include "traversals/strategies.h"

namespace hlodbench {
namespace {

class SimpPredictor final : public Predictor {
 public:
  explicit SimpPredictor(SimpEstimate estimate) : estimate_(estimate) {}

  void beginFrame(const FrameView& /*view*/) override {
    bias_ = 1.0;  // nothing processed yet: as conservative as Bool
    sum_ = 0.0;
    results_ = 0;
  }

  Prediction predict(NodeId node, const FrameView& view) override {
    if (!view.wasVisible(node)) return Prediction::kDelay;
    return bias_ * view.computeSse(node) <= view.tau() ? Prediction::kStop : Prediction::kRefine;
  }

  void onResult(NodeId node, const FrameView& view) override {
    if (view.state(node).pixels == 0) return;
    const double bias = view.state(node).bias;
    sum_ += bias;
    ++results_;
    bias_ = estimate_ == SimpEstimate::kLastProcessed ? bias : sum_ / results_;
  }

 private:
  SimpEstimate estimate_;
  double bias_ = 1.0;  // the estimate for the node that comes next
  double sum_ = 0.0;
  int results_ = 0;
};

}  // namespace

std::unique_ptr<Strategy> makeSimpStrategy(const StrategyInputs& inputs) {
  return std::make_unique<CoherentTraversal>(
      inputs.hierarchy, inputs.options, Modulation::kBias,
      std::make_unique<SimpPredictor>(inputs.options.simpEstimate));
}

}  // namespace hlodbench
