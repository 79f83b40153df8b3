#include "traversals/front_recording.h"

#include <stdexcept>

namespace hlodbench {

RecordedFrame makeRecordedFrame(const Trace& events, const FrameRecord& record) {
  RecordedFrame frame{{}, {}, {}, record};
  for (std::size_t i = 0; i < events.size(); ++i) {
    const TraceEvent& event = events[i];
    switch (event.type) {
      case TraceEvent::Type::kDraw:
        frame.drawn.push_back(event.node);
        break;
      case TraceEvent::Type::kResult:
        if (event.pixels == 0)
          frame.hidden.push_back(event.node);
        else if (!event.stop)
          frame.refined.push_back(event.node);
        break;
      case TraceEvent::Type::kNear: {
        // decided at once: drawn next, or refined
        const bool isDrawn = i + 1 < events.size() &&
                             events[i + 1].type == TraceEvent::Type::kDraw &&
                             events[i + 1].node == event.node;
        if (!isDrawn) frame.refined.push_back(event.node);
        break;
      }
      case TraceEvent::Type::kRarn:
        throw std::invalid_argument("makeRecordedFrame: expected a frame of SW(B), found a RARN");
      case TraceEvent::Type::kVisit:
      case TraceEvent::Type::kQuery:
        break;
    }
  }
  return frame;
}

}  // namespace hlodbench
