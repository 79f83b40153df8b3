// What a replay costs besides drawing: the log of frames, and a strategy's own work a visited node.
// Compare with --benchmark_enable_random_interleaving=true --benchmark_repetitions=15.

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

#include "gl_frame_services.h"
#include "hlod/build/hierarchy_builder.h"
#include "hlod/query/scripted_query_source.h"
#include "hlod/render/frame_pacer.h"
#include "hlod/render/gl_context.h"
#include "hlod/render/gl_query_source.h"
#include "hlod/scene/courtyard.h"
#include "replay.h"
#include "traversals/registry.h"

namespace hlodbench {
namespace {

const Hierarchy& courtyard() {
  static const Hierarchy hierarchy = [] {
    BuildReport report;
    return buildHierarchy(generateCourtyard({.seed = 1, .triangles = 400'000}), {}, report);
  }();
  return hierarchy;
}

// A round through the courtyard's garden, looking ahead.
const Session& walk() {
  static const Session session = [] {
    Session out;
    out.name = "round";
    out.lens.nearPlane = 0.05;
    constexpr int kFrames = 120;
    for (int i = 0; i < kFrames; ++i) {
      const double angle = 6.283185307179586 * i / kFrames;
      out.poses.push_back({glm::dvec3(6.0 * std::cos(angle), 1.7, 4.0 * std::sin(angle)),
                           glm::angleAxis(-angle, glm::dvec3(0.0, 1.0, 0.0))});
    }
    return out;
  }();
  return session;
}

// Looks away from the courtyard: nothing is drawn but the sky, so what is done for each frame
// shows.
const Session& sky() {
  static const Session session = [] {
    Session out = walk();
    for (Pose& pose : out.poses) pose.position.y = 1000.0;
    return out;
  }();
  return session;
}

// One context and renderer for all benchmarks with GL; null where there is none.
struct Stage {
  std::unique_ptr<GlContext> context = createContext("auto", {});
  Renderer renderer{courtyard(), walk().lens.width, walk().lens.height};
  GlQuerySource queries{renderer, courtyard().nodes.size()};
};

Stage& stage() {
  static Stage only;
  return only;
}

// As `hlodbench run` replays: timers, counters, a record a frame, hooks.
void replayLogged(benchmark::State& state, const Session& session) {
  for (auto _ : state) {
    const auto strategy = findStrategy("coh-b").make({courtyard()});
    ReplayHooks hooks;
    int frames = 0;
    hooks.onFrame = [&](int) { ++frames; };
    benchmark::DoNotOptimize(
        replaySession(session, *strategy, stage().renderer, stage().queries, {}, hooks));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(session.poses.size()));
}
BENCHMARK_CAPTURE(replayLogged, walk, walk())->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(replayLogged, sky, sky())->Unit(benchmark::kMillisecond)->UseRealTime();

// Drawing and asking, without a clock.
class BareServices final : public FrameServices {
 public:
  BareServices(Renderer& renderer, QuerySource& queries) : renderer_(renderer), queries_(queries) {}
  void draw(NodeId node) override {
    ++calls_;
    renderer_.drawNode(node);
    queries_.noteDraw();
  }
  void issueQuery(NodeId node) override {
    ++calls_;
    queries_.issue(node);
  }
  bool isAvailable(NodeId node) override {
    ++calls_;
    return queries_.isAvailable(node);
  }
  std::uint32_t getResult(NodeId node) override {
    ++calls_;
    return queries_.getResult(node);
  }
  [[nodiscard]] std::int64_t calls() const { return calls_; }

 private:
  Renderer& renderer_;
  QuerySource& queries_;
  std::int64_t calls_ = 0;
};

// The same frames with nothing measured and nothing kept, but for how often the strategy calls.
void replayBare(benchmark::State& state, const Session& session) {
  std::int64_t calls = 0;
  for (auto _ : state) {
    const auto strategy = findStrategy("coh-b").make({courtyard()});
    BareServices services(stage().renderer, stage().queries);
    FramePacer pacer(ReplayOptions().framesInFlight);
    FrameRecord record;
    for (const Pose& pose : session.poses) {
      const Camera camera = makeCamera(session.lens, pose);
      stage().queries.beginFrame();
      stage().renderer.beginFrame(camera);
      strategy->renderFrame(camera, services, record, nullptr);
      pacer.endFrame();
    }
    calls += services.calls();
  }
  const auto frames = state.iterations() * static_cast<std::int64_t>(session.poses.size());
  state.SetItemsProcessed(frames);
  state.counters["calls_a_frame"] = static_cast<double>(calls) / static_cast<double>(frames);
}
BENCHMARK_CAPTURE(replayBare, walk, walk())->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(replayBare, sky, sky())->Unit(benchmark::kMillisecond)->UseRealTime();

// What timing a call of a strategy adds to it: twice the clock. Items are calls.
void timeCalls(benchmark::State& state) {
  ScriptedQuerySource queries([](NodeId) { return 1u; }, courtyard().nodes.size());
  GlFrameServices services(stage().renderer, queries);
  queries.beginFrame();
  services.issueQuery(kRoot);
  for (auto _ : state) benchmark::DoNotOptimize(services.isAvailable(kRoot));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(timeCalls);

// Draws nothing; every box is seen by a fixed share of its pixels.
class NoServices final : public FrameServices {
 public:
  explicit NoServices(QuerySource& queries) : queries_(queries) {}
  void draw(NodeId node) override { benchmark::DoNotOptimize(node); }
  void issueQuery(NodeId node) override { queries_.issue(node); }
  bool isAvailable(NodeId node) override { return queries_.isAvailable(node); }
  std::uint32_t getResult(NodeId node) override { return queries_.getResult(node); }

 private:
  QuerySource& queries_;
};

// The strategy alone; items are visited nodes.
void traverse(benchmark::State& state, const char* name) {
  const auto strategy = findStrategy(name).make({courtyard()});
  ScriptedQuerySource queries([](NodeId node) { return node % 5 == 0 ? 0u : 200u; },
                              courtyard().nodes.size());
  NoServices services(queries);
  FrameRecord record;
  double visited = 0.0;
  for (auto _ : state) {
    for (const Pose& pose : walk().poses) {
      strategy->renderFrame(makeCamera(walk().lens, pose), services, record, nullptr);
      visited += record.get(Counter::kNodesVisited);
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(visited));
}
BENCHMARK_CAPTURE(traverse, bool, "bool")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(traverse, sw, "sw-b")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(traverse, simp, "simp-b")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(traverse, coh, "coh-b")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hlodbench
