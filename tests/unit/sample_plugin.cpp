// Strategies in the form of a plug-in, compiled as a part of a program: what stands here could as
// well be a library.
#define HLODBENCH_IN_TREE
#include <hlodbench/plugin.h>

#include <functional>
#include <stdexcept>

#include "sample_plugin.h"

namespace {

using namespace hlodbench::plugin;

constexpr OptionInfo kOptions[] = {numberOption("weight", 0, 2, 1, "of the error")};

class SamplePredictor final : public Predictor {
 public:
  explicit SamplePredictor(const OptionValues& own) : weight_(own.number("weight")) {}
  Prediction predict(NodeId node, const FrameView& view) override {
    if (!view.wasVisible(node)) return Prediction::kDelay;
    return weight_ * view.computeSse(node) <= view.tau() ? Prediction::kStop : Prediction::kRefine;
  }

 private:
  double weight_;
};

// Does what the test says.
class SampleStrategy final : public Strategy {
 public:
  void renderFrame(const FrameView& view, Frame& frame) override {
    hlodbench::sampleFrame(view, frame);
  }
};

}  // namespace

namespace hlodbench {
std::function<void(const plugin::FrameView&, plugin::Frame&)> sampleFrame;
}

HLODBENCH_PLUGIN(sample,
                 describe<SamplePredictor>("sample", "Sample", "Bool, in the form of a plug-in",
                                           kOptions, Modulation::kNone),
                 describe<SampleStrategy>("script", "Script", "what a test says"));
