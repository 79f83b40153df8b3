#include "record_fronts.h"

#include "replay.h"
#include "traversals/strategies.h"

namespace hlodbench {

FrontRecording recordFronts(const Hierarchy& hierarchy, const TraversalOptions& options,
                            const Session& session, Renderer& renderer, QuerySource& queries,
                            const std::function<bool()>& isInterrupted, const Progress& progress) {
  const auto frames = static_cast<double>(session.poses.size());
  FrontRecording recording;
  ReplayHooks hooks;
  hooks.isInterrupted = isInterrupted;
  hooks.onTrace = [&](TracedFrame&& frame) {
    recording.frames.push_back(makeRecordedFrame(frame.events, frame.record));
    if (progress)
      progress("fronts of SW(B)", static_cast<double>(recording.frames.size()) / frames);
  };
  const auto strategy = makeStopAndWaitStrategy({hierarchy, options});
  replaySession(session, *strategy, renderer, queries, {}, hooks);
  return recording;
}

}  // namespace hlodbench
