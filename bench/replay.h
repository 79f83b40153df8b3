#pragma once

#include <functional>
#include <vector>

#include "hlod/query/query_source.h"
#include "hlod/render/renderer.h"
#include "metrics/counters.h"
#include "session.h"
#include "test_slowdown.h"
#include "traversals/strategy.h"
#include "turns.h"

namespace hlodbench {

struct ReplayOptions {
  int warmUpFrames = 5;    // first frames of the session that are marked as warm-up
  int framesInFlight = 1;  // frames that the CPU may run ahead; 0 finishes each frame
  Slowdown slowdown = {};  // for tests
};

// What happened in one frame, for the trace.
struct TracedFrame {
  Pose pose;
  Trace events;
  FrameRecord record;
};

// Where a replay's frames go besides its records; each may be empty.
struct ReplayHooks {
  std::function<void(int frame)> onFrame;      // after each frame: progress
  std::function<void(TracedFrame&&)> onTrace;  // asks for events,
  std::function<bool(int frame)> isTraced;     // of these frames; empty: of all
  std::function<bool()> isInterrupted = [] { return false; };
  Turns* turns = nullptr;  // with another program; null: none are taken
};

// Replays a session by frame index, once, with a strategy that starts cold. Returns one record a
// frame, fewer when it was interrupted.
std::vector<FrameRecord> replaySession(const Session& session, Strategy& strategy,
                                       Renderer& renderer, QuerySource& queries,
                                       const ReplayOptions& options, const ReplayHooks& hooks);

}  // namespace hlodbench
