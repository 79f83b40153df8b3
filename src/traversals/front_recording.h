#pragma once

#include <cstddef>
#include <vector>

#include "metrics/counters.h"
#include "traversals/trace_event.h"

namespace hlodbench {

// How SW(B) decided every node that it took up inside the frustum, in one frame.
struct RecordedFrame {
  std::vector<NodeId> drawn;    // where refinement ended: the front, as it was drawn, front to back
  std::vector<NodeId> refined;  // in the order of the decisions
  std::vector<NodeId> hidden;   // no pixel of their query passed
  FrameRecord record;           // SW(B)'s counters of the frame
};

// The fronts of SW(B) over a whole session: what strategies that know the answer draw or predict
// by, and what predictions are judged by.
struct FrontRecording {
  std::vector<RecordedFrame> frames;  // by frame of the session
};

// events: one frame of SW(B), and its counters. Throws std::invalid_argument for a RARN, which no
// frame of SW(B) has.
RecordedFrame makeRecordedFrame(const Trace& events, const FrameRecord& record);

}  // namespace hlodbench
