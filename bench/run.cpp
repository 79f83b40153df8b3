#include "run.h"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>

#include "case_plan.h"
#include "explain_pass.h"
#include "hierarchy_store.h"
#include "hlod/core/error.h"
#include "hlod/render/gl_context.h"
#include "hlod/render/gl_query_source.h"
#include "hlod/tree/hasher.h"
#include "interrupt.h"
#include "metrics/frame_csv.h"
#include "metrics/result_json.h"
#include "metrics/text_file.h"
#include "noted_fronts.h"
#include "overlay.h"
#include "picture_pass.h"
#include "progress_line.h"
#include "record_fronts.h"
#include "result_folder.h"
#include "run_options_json.h"
#include "strategy_settings.h"
#include "trace_file.h"
#include "traversals/plugin_library.h"
#include "viewport_size.h"

namespace hlodbench {
namespace {

#ifdef NDEBUG
constexpr bool kDebugBuild = false;
#else
constexpr bool kDebugBuild = true;
#endif

constexpr const char* kNotedFronts = "fronts.tmp";  // only while a run goes on

std::uint64_t hashText(const std::string& text) {
  return computeHash(std::as_bytes(std::span(text)));
}

// trace.jsonl of several strategies: trace.coh-b.jsonl and so on.
std::filesystem::path nameTrace(const RunOptions& options, const std::string& strategy) {
  if (options.strategies.size() == 1) return options.trace;
  return options.trace.parent_path() /
         (options.trace.stem().string() + "." + strategy + options.trace.extension().string());
}

std::vector<StrategyInfo> loadStrategies(const RunOptions& options, const Watch& watch) {
  const auto onLoad = [&](int plugin) {
    watch.heartbeat->enter(Heartbeat::Stage::kLoading, plugin);
  };
  std::vector<StrategyInfo> all = listStrategies(options.plugins, onLoad);
  watch.heartbeat->enter(Heartbeat::Stage::kOther);
  return all;
}

std::vector<const StrategyInfo*> findAll(const std::vector<std::string>& names,
                                         const std::vector<StrategyInfo>& strategies) {
  std::vector<const StrategyInfo*> found;
  for (const std::string& name : names) found.push_back(&findStrategy(name, strategies));
  return found;
}

// isContinued: an earlier process checked the files, and has written some.
void checkOptions(const RunOptions& options, const Session& session, bool isContinued) {
  if (options.strategies.empty()) throw InputError("--strategy: expected at least one, found none");
  for (const std::string& strategy : options.strategies) {
    if (std::count(options.strategies.begin(), options.strategies.end(), strategy) > 1)
      throw InputError(fmt::format("--strategy: expected each once, found '{}' twice", strategy));
    if (!options.trace.empty() && !isContinued &&
        std::filesystem::exists(nameTrace(options, strategy)))
      throw InputError(fmt::format("--trace {}: expected a new file, found one that exists",
                                   nameTrace(options, strategy).string()));
  }
  const std::filesystem::path traceFolder = options.trace.parent_path();
  if (!traceFolder.empty() && !std::filesystem::is_directory(traceFolder))
    throw InputError(fmt::format("--trace {}: expected a file in a folder that exists, found none",
                                 options.trace.string()));
  if (options.turns && !options.plugins.empty())
    throw InputError(
        "--turns: expected no --plugin, whose frames are timed as they wait, found one");
  const int frames = static_cast<int>(session.poses.size());
  if (options.replay.warmUpFrames >= frames)
    throw InputError(fmt::format("--warm-up: expected fewer than the session's {} frames, found {}",
                                 frames, options.replay.warmUpFrames));
  for (const std::string& overlay : options.pictures.overlays) findOverlay(overlay);
}

void announce(const GlContext& context) {
  for (const std::string& line : context.tried) fmt::print(stderr, "  {}\n", line);
  fmt::print(stderr, "context {}: {}; {}, OpenGL {}\n", context.name, context.detail,
             context.renderer, context.version);
}

// One run: what all its replays share.
class Runner {
 public:
  Runner(const RunOptions& options, const std::vector<std::string>& arguments, const Watch& watch)
      : options_(options),
        watch_(watch),
        strategies_(loadStrategies(options, watch)),
        settings_(findAll(options.strategies, strategies_), options.settings),
        latency_(parseLatency(options.latency)) {
    session_ = readSession(options.session);
    applySize(options.size, session_.lens);
    checkOptions(options, session_, watch.isContinued);
    if (options.turns) turns_.emplace(*options.turns, options.turnFrames);
    imageFrames_ = selectFrames(options.images, static_cast<int>(session_.poses.size()),
                                options.replay.warmUpFrames, options.seed);
    explainFrames_ = selectFrames(options.explain, static_cast<int>(session_.poses.size()),
                                  options.replay.warmUpFrames, options.seed, "--explain");
    // what may be wrong is found out before the scene is built, which may take minutes
    context_ = createContext(options.context, {options.glDebug || kDebugBuild});
    const bool isNewFolder = !watch.isContinued && makeResultFolder(options.out);
    try {
      load();
    } catch (...) {
      std::error_code ignored;
      if (isNewFolder) std::filesystem::remove(options.out, ignored);
      throw;
    }
    plan_ = planCases(options.strategies, options.repetitions, options.seed);
    if (watch.isContinued && std::filesystem::exists(options.out / kResultFileName))
      resume();
    else
      describe(arguments);
  }

  bool runAll() {
    catchInterrupts();
    if (needsRecording()) record();
    {
      ProgressLine line(fmt::format("replaying {}", session_.name));
      for (std::size_t i = 0; i < plan_.size() && !isInterrupted(); ++i) {
        const int order = static_cast<int>(i);
        if (isDone(plan_[i])) continue;
        if (const LostCase* lost = findLost(plan_[i].strategy))
          recordLost(plan_[i], order, *lost);
        else
          runCase(plan_[i], order, line);
        // after each case: whatever happens next, what is complete stays
        finishRun(result_, plan_);
        writeRunResult(options_.out, result_);
      }
    }
    const bool isUnexplained = !isInterrupted() ? !explain() : !explainFrames_.empty();
    const bool picturesAreMissing = !isInterrupted() ? !writePictures() : !imageFrames_.empty();
    bool failed = false;
    for (const CaseResult& c : result_.cases)
      if (c.error) {
        fmt::print(stderr, "hlodbench: {} repetition {} failed: {}\n", c.key.strategy,
                   c.key.repetition, *c.error);
        failed = true;
      }
    if (!result_.complete)
      fmt::print(stderr, "hlodbench: interrupted; {} of {} replays are complete in {}\n",
                 result_.cases.size(), plan_.size(), options_.out.string());
    else if (isUnexplained)
      fmt::print(stderr, "hlodbench: interrupted; counters of --explain are missing in {}\n",
                 options_.out.string());
    else if (picturesAreMissing)
      fmt::print(stderr, "hlodbench: interrupted; pictures are missing in {}\n",
                 options_.out.string());
    return result_.complete && !failed && !isUnexplained && !picturesAreMissing;
  }

 private:
  // One replay whose frames are to be explained: what to do it from.
  struct Replay {
    std::string strategy;
    std::vector<FrameDecisions> decisions;
    std::vector<FrameRecord> records;
  };

  void load() {
    stored_ = openHierarchy(options_.scene, options_.cache, options_.build);
    announce(*context_);
    const auto start = std::chrono::steady_clock::now();
    renderer_ = std::make_unique<Renderer>(
        stored_.hierarchy, session_.lens.width, session_.lens.height,
        RendererOptions{.gpuMemory = options_.gpuMemory,
                        .culling = options_.faces,
                        .queryFaces = options_.queryFaces,
                        .clipsBoxes = options_.traversal.nearPlane == NearPlane::kVisible});
    glFinish();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    const auto toMiB = [](std::uint64_t bytes) { return static_cast<double>(bytes) / (1 << 20); };
    fmt::print(stderr, "  geometry: {:.0f} MiB, of which {:.0f} checked and uploaded in {:.2f} s\n",
               toMiB(stored_.hierarchy.geometry.bytes().size()),
               toMiB(renderer_->residency().residentBytes), seconds.count());
    glQueries_ = std::make_unique<GlQuerySource>(*renderer_, stored_.hierarchy.nodes.size());
    queries_ = wrapQuerySource(*glQueries_, latency_, stored_.hierarchy.nodes.size());
  }

  void describe(const std::vector<std::string>& arguments) {
    result_.environment =
        readEnvironment(arguments, {context_->vendor, context_->renderer, context_->version});
    result_.warnings = computeWarnings(result_.environment);
    const std::string otherScene =
        describeOtherScene(session_, stored_.sceneName, stored_.info.sceneHash);
    if (!otherScene.empty()) result_.warnings.push_back(otherScene);
    if (options_.replay.slowdown.isAny())
      result_.warnings.push_back(describeSlowdown(options_.replay.slowdown));
    for (const std::string& warning : result_.warnings)
      fmt::print(stderr, "warning: {}\n", warning);
    result_.scene = {stored_.sceneName,
                     fmt::format("{:016x}", stored_.info.contentHash),
                     stored_.hierarchy.inputTriangles,
                     stored_.hierarchy.nodes.size(),
                     {{"options", stored_.info.options},
                      {"scene_hash", fmt::format("{:016x}", stored_.info.sceneHash)}}};
    result_.session = {session_.name,
                       fmt::format("{:016x}", hashText(readTextFile(options_.session))),
                       static_cast<int>(session_.poses.size())};
    result_.options = toJson(options_, settings_, session_.lens);
    result_.framesInFlight = options_.replay.framesInFlight;
    result_.warmUpFrames = options_.replay.warmUpFrames;
    result_.repetitions = options_.repetitions;
  }

  [[nodiscard]] bool needsRecording() const {
    const auto& names = options_.strategies;
    return !explainFrames_.empty() ||
           std::any_of(names.begin(), names.end(), [this](const std::string& name) {
             return findStrategy(name, strategies_).needsRecording;
           });
  }

  // Before anything is timed.
  void record() {
    ProgressLine line("recording");
    recording_ = recordFronts(stored_.hierarchy, options_.traversal, session_, *renderer_,
                              *queries_, isInterrupted, line.asProgress());
    if (!isInterrupted()) return;
    finishRun(result_, plan_);
    writeRunResult(options_.out, result_);
  }

  // Goes on from what an earlier process has written.
  void resume() {
    result_ = readRunResult(options_.out);
    if (const auto file = options_.out / kNotedFronts; std::filesystem::exists(file))
      fronts_ = readNotedFronts(file);
  }

  [[nodiscard]] bool isDone(const CaseKey& key) const {
    return std::any_of(result_.cases.begin(), result_.cases.end(),
                       [&](const CaseResult& c) { return c.key == key; });
  }

  [[nodiscard]] const LostCase* findLost(const std::string& strategy) const {
    const auto lost = std::find_if(watch_.lost.begin(), watch_.lost.end(), [&](const LostCase& c) {
      return plan_[c.index].strategy == strategy;
    });
    return lost == watch_.lost.end() ? nullptr : &*lost;
  }

  void recordLost(const CaseKey& key, int order, const LostCase& lost) {
    const StrategyInfo& info = findStrategy(key.strategy, strategies_);
    const std::string error = order == lost.index
                                  ? lost.error
                                  : fmt::format("not replayed after repetition {}: {}",
                                                plan_[lost.index].repetition, lost.error);
    result_.cases.push_back({key, std::string(info.label), order, "", error, std::nullopt});
  }

  void runCase(const CaseKey& key, int order, ProgressLine& line) {
    const StrategyInfo& info = findStrategy(key.strategy, strategies_);
    CaseResult result{key, std::string(info.label), order, "", std::nullopt, std::nullopt};
    try {
      const std::vector<FrameRecord> records = replay(info, key.repetition, order, line);
      if (isInterrupted() && records.size() < session_.poses.size()) return;
      result.csv = fmt::format("{}.{}.csv", key.strategy, key.repetition);
      writeFrameCsv(options_.out / result.csv, records);
      result.summary = computeSummary(records);
    } catch (const InputError&) {
      throw;  // a full disk or the like: nothing after it can succeed
    } catch (const std::exception& error) {
      result.csv.clear();
      result.error = describeError(error.what());
    } catch (...) {
      result.csv.clear();
      result.error = describeError("an exception that is no std::exception");
    }
    watch_.heartbeat->enter(Heartbeat::Stage::kOther);
    result_.cases.push_back(std::move(result));
  }

  // What went wrong in the replay that is running, in one line, with its frame.
  [[nodiscard]] std::string describeError(std::string what) const {
    std::replace(what.begin(), what.end(), '\n', ' ');
    const int frame = watch_.heartbeat->frame;
    return frame < 0 ? what : fmt::format("frame {}: {}", frame, what);
  }

  std::vector<FrameRecord> replay(const StrategyInfo& info, int repetition, int order,
                                  ProgressLine& line) {
    watch_.heartbeat->enter(Heartbeat::Stage::kReplay, order);
    auto strategy =
        info.make({stored_.hierarchy, options_.traversal, &recording_, settings_.of(info.name)});
    watch_.heartbeat->frame = 0;
    ReplayHooks hooks;
    hooks.isInterrupted = isInterrupted;
    if (turns_) hooks.turns = &*turns_;
    hooks.onFrame = [&](int frame) {
      watch_.heartbeat->frame = frame + 1;
      const double done = order + static_cast<double>(frame + 1) / session_.poses.size();
      line.update(
          fmt::format("{}, repetition {} of {}", info.label, repetition + 1, options_.repetitions),
          done / plan_.size());
    };
    std::vector<TracedFrame> traced;
    StrategyFronts fronts{std::string(info.name), std::string(info.label), {}};
    std::vector<FrameDecisions> decisions;
    const bool tracing = !options_.trace.empty() && repetition == 0;
    if (repetition == 0 && (tracing || !imageFrames_.empty() || !explainFrames_.empty())) {
      hooks.isTraced = [&](int frame) {
        return tracing || isPictured(frame) || isExplained(frame);
      };
      hooks.onTrace = [&](TracedFrame&& f) {
        if (isPictured(f.record.frame) && info.name != kFullModel)
          fronts.fronts.push_back(computeFront(f.record.frame, f.events));
        if (isExplained(f.record.frame))
          decisions.push_back(collectDecisions(f.record.frame, f.events));
        // written after the replay, so that the disk takes no part in the timings
        if (tracing) traced.push_back(std::move(f));
      };
    }
    std::vector<FrameRecord> records =
        replaySession(session_, *strategy, *renderer_, *queries_, options_.replay, hooks);
    watch_.heartbeat->frame = Heartbeat::kRemoving;
    strategy.reset();
    watch_.heartbeat->enter(Heartbeat::Stage::kOther);
    if (tracing && !isInterrupted()) writeTrace(std::string(info.name), traced);
    if (!fronts.fronts.empty()) {
      fronts_.push_back(std::move(fronts));
      // for the case that a plug-in ends this process before the pictures are drawn
      if (!options_.plugins.empty()) writeNotedFronts(options_.out / kNotedFronts, fronts_);
    }
    if (!decisions.empty() && !isInterrupted())
      explained_.push_back({std::string(info.name), std::move(decisions), records});
    return records;
  }

  [[nodiscard]] bool isPictured(int frame) const {
    return std::binary_search(imageFrames_.begin(), imageFrames_.end(), frame);
  }

  [[nodiscard]] bool isExplained(int frame) const {
    return std::binary_search(explainFrames_.begin(), explainFrames_.end(), frame);
  }

  // Adds the counters of --explain to the logs and summaries of the first repetition. Returns
  // whether all are there.
  bool explain() {
    if (explained_.empty()) return true;
    ProgressLine line("explaining");
    for (std::size_t i = 0; i < explained_.size(); ++i) {
      Replay& replay = explained_[i];
      const Progress progress = [&](const std::string&, double share) {
        line.update(replay.strategy,
                    (static_cast<double>(i) + share) / static_cast<double>(explained_.size()));
      };
      if (!explainFrames(stored_.hierarchy, *renderer_, session_, recording_, replay.decisions,
                         isInterrupted, progress, replay.records))
        return false;
      for (CaseResult& c : result_.cases) {
        if (c.key != CaseKey{replay.strategy, 0}) continue;
        writeFrameCsv(options_.out / c.csv, replay.records);
        c.summary = computeSummary(replay.records);
      }
      writeRunResult(options_.out, result_);
    }
    return true;
  }

  void writeTrace(const std::string& strategy, const std::vector<TracedFrame>& frames) {
    TraceFile file(nameTrace(options_, strategy),
                   {strategy, options_.traversal, options_.queryFaces, session_.lens, latency_,
                    stored_.info.contentHash});
    for (const TracedFrame& frame : frames) file.writeFrame(frame);
    file.finish();
  }

  // Returns whether every picture is there.
  bool writePictures() {
    if (imageFrames_.empty()) return true;
    const std::filesystem::path folder = options_.out / kImageFolder;
    makeResultFolder(folder);
    // the order in which they were asked for, not that of the replays
    const auto rank = [&](const StrategyFronts& fronts) {
      return std::find(options_.strategies.begin(), options_.strategies.end(), fronts.strategy);
    };
    std::sort(fronts_.begin(), fronts_.end(),
              [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    ImageResult images;
    images.selection = options_.images.name();
    images.seed = options_.seed;
    images.frames = imageFrames_;
    images.crackMargin = computeCrackMargin(options_.traversal.tau);
    drawPictures(stored_.hierarchy, *renderer_, session_, fronts_, options_.pictures, folder,
                 isInterrupted, images);
    writeImageResult(folder, images);
    return images.complete;
  }

  const RunOptions& options_;
  const Watch& watch_;
  std::vector<StrategyInfo> strategies_;  // those of the tree and of the plug-ins
  StrategySettings settings_;
  Latency latency_;
  Session session_;
  std::optional<Turns> turns_;
  StoredHierarchy stored_;
  std::unique_ptr<GlContext> context_;  // before everything that lives in it
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<GlQuerySource> glQueries_;
  std::unique_ptr<QuerySource> queries_;
  std::vector<CaseKey> plan_;
  std::vector<int> imageFrames_;        // ascending
  std::vector<StrategyFronts> fronts_;  // in these frames, of the first repetition
  std::vector<int> explainFrames_;      // ascending
  std::vector<Replay> explained_;  // those of the first repetition, where there are such frames
  FrontRecording recording_;       // of SW(B), where something needs it
  RunResult result_;
};

}  // namespace

bool run(const RunOptions& options, const std::vector<std::string>& arguments, const Watch& watch) {
  return Runner(options, arguments, watch).runAll();
}

SupervisorOptions makeSupervisorOptions(const RunOptions& options) {
  const std::filesystem::path traces = options.trace.parent_path();
  return {options.frameTimeout,
          options.plugins,
          {options.out, options.out / kImageFolder, traces.empty() ? "." : traces},
          {options.out / kNotedFronts}};
}

}  // namespace hlodbench
