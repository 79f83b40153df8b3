#include "explain_pass.h"

#include "visible_parts.h"

namespace hlodbench {
namespace {

void storePredictions(const PredictionCounts& counts, FrameRecord& record) {
  record.set(Counter::kPredictedRight, counts.right);
  record.set(Counter::kTooConservative, counts.tooConservative);
  record.set(Counter::kTooAggressive, counts.tooAggressive);
  record.set(Counter::kNeedlessDelays, counts.needlessDelays);
}

void storeVisibleParts(const VisibleParts& parts, std::size_t drawn, FrameRecord& record) {
  const auto triangles = static_cast<double>(parts.triangles);
  record.set(Counter::kInvisibleNodes, static_cast<double>(drawn - parts.nodes));
  record.set(Counter::kVisibleTriangles, triangles);
  record.set(Counter::kInvisibleTriangles, record.get(Counter::kTriangles) - triangles);
}

}  // namespace

FrameDecisions collectDecisions(int frame, const Trace& events) {
  FrameDecisions decisions{frame, {}, {}};
  for (const TraceEvent& event : events) {
    if (event.type == TraceEvent::Type::kVisit && event.inFrustum)
      decisions.predictions.push_back({event.node, event.prediction});
    else if (event.type == TraceEvent::Type::kDraw)
      decisions.drawn.push_back(event.node);
  }
  return decisions;
}

bool explainFrames(const Hierarchy& hierarchy, Renderer& renderer, const Session& session,
                   const FrontRecording& recording, const std::vector<FrameDecisions>& decisions,
                   const std::function<bool()>& isInterrupted, const Progress& progress,
                   std::vector<FrameRecord>& records) {
  for (std::size_t i = 0; i < decisions.size(); ++i) {
    if (isInterrupted()) return false;
    const FrameDecisions& frame = decisions[i];
    const auto index = static_cast<std::size_t>(frame.frame);
    FrameRecord& record = records.at(index);
    if (record.has(Counter::kQueries) && !frame.predictions.empty())
      storePredictions(judgePredictions(hierarchy, frame.predictions, recording.frames.at(index)),
                       record);
    const Camera camera = makeCamera(session.lens, session.poses.at(index));
    if (const auto parts = countVisibleParts(hierarchy, renderer, camera, frame.drawn))
      storeVisibleParts(*parts, frame.drawn.size(), record);
    if (progress) progress("", static_cast<double>(i + 1) / static_cast<double>(decisions.size()));
  }
  return true;
}

}  // namespace hlodbench
