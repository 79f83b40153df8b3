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

  void beginFrame(const PredictionContext& /*context*/) override {
    bias_ = 1.0;  // nothing processed yet: as conservative as Bool
    sum_ = 0.0;
    results_ = 0;
  }

  Prediction predict(NodeId node, const PredictionContext& context) override {
    if (!context.wasVisible(node)) return Prediction::kDelay;
    return bias_ * context.computeSse(node) <= context.options.tau ? Prediction::kStop
                                                                   : Prediction::kRefine;
  }

  void onVisible(NodeId /*node*/, double bias) override {
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
