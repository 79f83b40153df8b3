// The limit of all predictors: the traversal of the paper (J. P. Charalambos et al., ISVC 2007,
// Fig. 2) when every prediction is right. It still queries what it draws and what is hidden.
#include "traversals/coherent_traversal.h"
#include "traversals/strategies.h"

namespace hlodbench {
namespace {

class IdealPredictor final : public Predictor {
 public:
  IdealPredictor(const FrontRecording& recording, std::size_t nodeCount)
      : recording_(recording), marks_(nodeCount) {}

  // Throws std::out_of_range after the last frame recorded.
  void beginFrame(const FrameView& view) override {
    const RecordedFrame& frame = recording_.frames.at(static_cast<std::size_t>(view.frame()));
    for (const NodeId node : frame.refined) marks_[node] = {view.frame(), Prediction::kRefine};
    for (const NodeId node : frame.drawn) marks_[node] = {view.frame(), Prediction::kStop};
  }

  // What SW(B) found hidden or did not reach is delayed: its result culls it.
  Prediction predict(NodeId node, const FrameView& view) override {
    const Mark& mark = marks_[node];
    return mark.frame == view.frame() ? mark.prediction : Prediction::kDelay;
  }

 private:
  struct Mark {
    int frame = -1;
    Prediction prediction = Prediction::kDelay;
  };

  const FrontRecording& recording_;
  std::vector<Mark> marks_;  // by node; of another frame: nothing
};

}  // namespace

std::unique_ptr<Strategy> makeIdealStrategy(const StrategyInputs& inputs) {
  return std::make_unique<CoherentTraversal>(
      inputs.hierarchy, inputs.options, Modulation::kBias,
      std::make_unique<IdealPredictor>(requireRecording(inputs), inputs.hierarchy.nodes.size()));
}

}  // namespace hlodbench
