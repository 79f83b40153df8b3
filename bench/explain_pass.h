#pragma once

#include <functional>
#include <string>
#include <vector>

#include "explain_predictions.h"
#include "hlod/core/progress.h"
#include "hlod/render/renderer.h"
#include "metrics/counters.h"
#include "session.h"

namespace hlodbench {

// What a strategy did in a frame that is to be explained.
struct FrameDecisions {
  int frame = 0;
  std::vector<PredictedNode> predictions;  // of nodes inside the frustum, in order
  std::vector<NodeId> drawn;               // in order
};

FrameDecisions collectDecisions(int frame, const Trace& events);

// Adds to the records of one replay what explains these frames of it: the optional counters of
// --explain. Predictions are judged by the recording; what is seen is counted in pictures that are
// drawn anew. A replay without queries predicts nothing and has no counters of it. Records hold
// each frame at its index. Stops early when interrupted; returns whether it is complete.
bool explainFrames(const Hierarchy& hierarchy, Renderer& renderer, const Session& session,
                   const FrontRecording& recording, const std::vector<FrameDecisions>& decisions,
                   const std::function<bool()>& isInterrupted, const Progress& progress,
                   std::vector<FrameRecord>& records);

}  // namespace hlodbench
