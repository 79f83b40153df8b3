// This work is based on:
// E. Gobbetti, F. Marton. Far Voxels. ACM TOG 24(3), SIGGRAPH 2005 (traversal known from its
//   description in the papers below).
// J. Bittner, M. Wimmer, H. Piringer, W. Purgathofer. Coherent Hierarchical Culling: Hardware
//   Occlusion Queries Made Useful. CGF 23(3), 2004.
// J. P. Charalambos et al. ISVC 2007, section 5.1: "HOQs were used as if their result were
// boolean". reconstruction: coherent hierarchical culling whose leaves are the nodes within
// tolerance.
#include "traversals/coherent_traversal.h"
#include "traversals/strategies.h"

namespace hlodbench {
namespace {

class BoolPredictor final : public Predictor {
 public:
  Prediction predict(NodeId node, const FrameView& view) override {
    if (!view.wasVisible(node)) return Prediction::kDelay;
    // the refinement condition needs no result: it is known now
    return view.computeSse(node) <= view.tau() ? Prediction::kStop : Prediction::kRefine;
  }
};

}  // namespace

std::unique_ptr<Strategy> makeBoolStrategy(const StrategyInputs& inputs) {
  return std::make_unique<CoherentTraversal>(inputs.hierarchy, inputs.options, Modulation::kNone,
                                             std::make_unique<BoolPredictor>());
}

}  // namespace hlodbench
