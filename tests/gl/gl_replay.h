#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl_scenes.h"
#include "hlod/render/gl_query_source.h"
#include "hlod/render/renderer.h"
#include "hlod/scene/courtyard.h"
#include "latency.h"
#include "record_fronts.h"
#include "replay.h"
#include "traversals/registry.h"

namespace hlodbench::testing {

// Replays sessions on one hierarchy. A context must be current as long as it lives.
class Rig {
 public:
  Rig(const Hierarchy& hierarchy, const Session& session, const RendererOptions& options = {})
      : hierarchy_(hierarchy),
        session_(session),
        renderer(hierarchy, session.lens.width, session.lens.height, options),
        glQueries(renderer, hierarchy.nodes.size()) {}

  std::vector<FrameRecord> replay(const std::string& strategy, const std::string& latency,
                                  const ReplayHooks& hooks = {},
                                  const TraversalOptions& traversal = {}, int framesInFlight = 1) {
    const auto queries = wrapQuerySource(glQueries, parseLatency(latency), hierarchy_.nodes.size());
    const StrategyInfo& info = findStrategy(strategy);
    FrontRecording recording;
    if (info.needsRecording) recording = record(traversal);
    const auto made = info.make({hierarchy_, traversal, &recording});
    return replaySession(session_, *made, renderer, *queries,
                         {.warmUpFrames = 0, .framesInFlight = framesInFlight}, hooks);
  }

  FrontRecording record(const TraversalOptions& traversal = {}) {
    return recordFronts(hierarchy_, traversal, session_, renderer, glQueries, [] { return false; },
                        {});
  }

 private:
  const Hierarchy& hierarchy_;
  const Session& session_;

 public:
  Renderer renderer;
  GlQuerySource glQueries;
};

// The counters that a fixed latency makes exact, of every frame; -1 for one that is absent.
inline std::vector<double> exactCounts(const std::vector<FrameRecord>& records) {
  std::vector<double> counts;
  for (const FrameRecord& record : records)
    for (const CounterInfo& info : kCounterTable)
      if (info.exactness == Exactness::kExact)
        counts.push_back(record.has(info.counter) ? record.get(info.counter) : -1.0);
  return counts;
}

inline double sum(const std::vector<FrameRecord>& records, Counter counter) {
  double total = 0.0;
  for (const FrameRecord& record : records) total += record.get(counter);
  return total;
}

inline Hierarchy buildSmallCourtyard() {
  return buildTestHierarchy(generateCourtyard({.seed = 1, .triangles = 60'000}), 200);
}

// A slow walk through the courtyard's ambulatory, past columns and bodies, into the garden.
inline Session makeWalk(int frames, int width, int height) {
  Session session;
  session.name = "walk";
  session.lens = makeLens(width, height);
  session.lens.nearPlane = 0.05;
  const glm::dvec3 eyes[] = {{9.4, 1.7, 4.9}, {9.4, 1.7, 3.5}, {9.2, 1.7, 1.5}, {8.1, 1.7, 0.15}};
  const glm::dvec3 targets[] = {
      {7.6, 1.45, 2.6}, {6.4, 1.45, 1.6}, {5.0, 1.4, 0.0}, {3.0, 1.35, -1.0}};
  for (int i = 0; i < frames; ++i) {
    const double at = 3.0 * i / frames;
    const int k = static_cast<int>(at);
    session.poses.push_back(lookAt(glm::mix(eyes[k], eyes[k + 1], at - k),
                                   glm::mix(targets[k], targets[k + 1], at - k)));
  }
  return session;
}

}  // namespace hlodbench::testing
