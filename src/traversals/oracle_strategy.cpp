// The limit of all strategies that draw the front of SW(B): the front is known before the frame
// and given to the renderer at once. No traversal, no query, no wait. What it takes is what drawing
// takes, and that part no strategy can save.
#include "traversals/strategies.h"

namespace hlodbench {
namespace {

class Oracle final : public Strategy {
 public:
  explicit Oracle(const FrontRecording& recording) : recording_(recording) {}

  // Throws std::out_of_range after the last frame recorded.
  void renderFrame(const Camera& /*camera*/, FrameServices& services, FrameRecord& record,
                   Trace* trace) override {
    const RecordedFrame& frame = recording_.frames.at(next_++);
    services.drawAll(frame.drawn);
    record.set(Counter::kDn, static_cast<double>(frame.drawn.size()));
    record.set(Counter::kTriangles, frame.record.get(Counter::kTriangles));
    record.set(Counter::kFrontChange, frame.record.get(Counter::kFrontChange));
    if (trace == nullptr) return;
    for (const NodeId node : frame.drawn) trace->push_back({TraceEvent::Type::kDraw, node});
  }

 private:
  const FrontRecording& recording_;
  std::size_t next_ = 0;  // frame
};

}  // namespace

std::unique_ptr<Strategy> makeOracleStrategy(const StrategyInputs& inputs) {
  return std::make_unique<Oracle>(requireRecording(inputs));
}

}  // namespace hlodbench
