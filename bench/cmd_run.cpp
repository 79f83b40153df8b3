#include <limits>
#include <memory>

#include "build_options.h"
#include "choice.h"
#include "commands.h"
#include "hierarchy_store.h"
#include "hlod/core/error.h"
#include "number_range.h"
#include "overlay.h"
#include "plugin_option.h"
#include "readings.h"
#include "renderer_options.h"
#include "run.h"
#include "strategy_settings.h"
#include "traversal_option.h"
#include "traversals/plugin_library.h"

namespace hlodbench {
namespace {

constexpr double kLargestSeed = 9007199254740991.0;  // every reader of JSON gets it exactly

std::vector<std::string> nameStrategies() {
  std::vector<std::string> names;
  for (const StrategyInfo& info : listStrategies()) names.emplace_back(info.name);
  return names;
}

void addPictureOptions(CLI::App& sub, RunOptions& o) {
  sub.add_option_function<std::string>(
         "--images", [&o](const std::string& text) { o.images = parseImageSelection(text); },
         "frames of the first repetition to keep as pictures and to compare with Bool's and with "
         "the full-resolution model, drawn again after everything was timed: all, none, a number "
         "of frames to choose at random, or a list like 0,120 (one frame: 7,)")
      ->default_str(std::to_string(o.images.count));
  addChoice<std::string>(sub, "--image-format", o.pictures.format, {{"png", "png"}, {"exr", "exr"}},
                         "of the pictures: 8-bit PNG, or OpenEXR with half floats");
  std::string overlays;
  for (const OverlayInfo& overlay : listOverlays())
    overlays += (overlays.empty() ? "" : ", ") + std::string(overlay.name);
  sub.add_option("--overlay", o.pictures.overlays,
                 "also write pictures in which the colour of each node tells something, see "
                 "`hlodbench list`; comma-separated: " +
                     overlays)
      ->delimiter(',');
}

void addExplainOption(CLI::App& sub, RunOptions& o) {
  sub.add_option_function<std::string>(
         "--explain",
         [&o](const std::string& text) { o.explain = parseImageSelection(text, "--explain"); },
         "frames of the first repetition for which to count, after everything was timed, how the "
         "predictions compare with SW(B) in the same frame and how much of what was drawn is seen: "
         "all, none, a number of frames or a list, as for --images")
      ->default_str(o.explain.name());
}

void addMeasuringOptions(CLI::App& sub, RunOptions& o) {
  sub.add_option("--repetitions", o.repetitions, "replays of the session by each strategy")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  sub.add_option("--warm-up", o.replay.warmUpFrames,
                 "first frames of the session that enter no average")
      ->capture_default_str()
      ->check(CLI::Range(0, 100000));
  sub.add_option("--frames-in-flight", o.replay.framesInFlight,
                 "frames the CPU may run ahead, as with a swap chain; 0 finishes each frame")
      ->capture_default_str()
      ->check(CLI::Range(0, 16));
  sub.add_option("--latency", o.latency,
                 "when query results are there: gl (the driver's), frames:N or draws:N after the "
                 "query (exactly repeatable counts)")
      ->capture_default_str();
  sub.add_option(
         "--turns", o.turns,
         "take turns with another hlodbench that replays the same session at the same time: "
         "the descriptor of an inherited end of a pair of connected stream sockets, from "
         "which a byte is read before each turn, and to which one is written after it")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  sub.add_option("--turn-frames", o.turnFrames,
                 "with --turns: frames of a turn; the last one is finished within its own time")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  sub.add_option("--seed", o.seed,
                 "of the order of the strategies in each repetition, and of "
                 "--images N and --explain N")
      ->capture_default_str()
      ->check(makeNumberRange(0.0, kLargestSeed));
}

std::string describeStrategyOptions(const std::vector<std::filesystem::path>& plugins) {
  std::string text;
  for (const StrategyInfo& info : listStrategies(plugins)) text += describeOptions(info);
  return "Options of single strategies (--set):\n" + (text.empty() ? "    none\n" : text);
}

}  // namespace

void addRunCommand(CLI::App& app, const std::vector<std::string>& arguments) {
  auto o = std::make_shared<RunOptions>();
  o->cache = getDefaultCacheFolder();
  CLI::App* sub = app.add_subcommand("run", "Replay a session with each strategy and log it");
  sub->add_option("--scene", o->scene,
                  "hierarchy (.hlod), or a scene or mesh file to build it from")
      ->required();
  sub->add_option("--session", o->session, "camera session (.json)")->required();
  sub->add_option("--out", o->out, "result folder; must be new or empty")->required();
  sub->add_option("--strategy", o->strategies,
                  "strategies, see `hlodbench list`; comma-separated, or all: those of the program")
      ->delimiter(',')
      ->capture_default_str();
  sub->add_option("--set", o->settings,
                  "STRATEGY.OPTION=VALUE: an option of one strategy, see below; may be repeated")
      ->allow_extra_args(false);
  addPluginOption(*sub, o->plugins);
  sub->add_option("--frame-timeout", o->frameTimeout,
                  "with --plugin: seconds that a frame may take, 0 for any time; a strategy that "
                  "takes longer fails, and the run goes on")
      ->capture_default_str()
      ->check(makeNumberRange(0.0, 86400.0));
  sub->footer([o] { return describeStrategyOptions(o->plugins); });
  addMemoryOption(*sub, o->gpuMemory);
  sub->add_option("--context", o->context, "auto, egl or osmesa")->capture_default_str();
  sub->add_option("--size", o->size, "viewport WIDTHxHEIGHT, pixels (default: the session's)");
  addMeasuringOptions(*sub, *o);
  addPictureOptions(*sub, *o);
  addExplainOption(*sub, *o);
  addTraversalOptions(*sub, o->traversal);
  addReadingOptions(*sub, o->traversal, o->queryFaces);
  sub->add_option("--trace", o->trace,
                  "write every decision of the first repetition as JSON Lines; with several "
                  "strategies, one file each, its name inserted before the extension");
  sub->add_option("--cache", o->cache, "folder of hierarchies built from a scene file")
      ->capture_default_str();
  sub->add_flag("--gl-debug", o->glDebug, "stop at every OpenGL error (on in debug builds)");
  addPresetOption(*sub, o->preset);
  addFacesOption(*sub, o->faces);
  addBuildOptions(*sub, o->build);
  sub->callback([o, arguments, sub] {
    refuseBuildOptions(*sub, o->scene);
    applyPreset(o->preset, *sub, o->build);
    if (o->strategies == std::vector<std::string>{"all"}) o->strategies = nameStrategies();
    if (o->preset == Preset::kBest) {
      if (sub->count("--tau") == 0) o->traversal.tau = kBestTau;
      if (sub->count("--faces") == 0) o->faces = FaceCulling::kBackWhereConsistent;
    }
    o->replay.slowdown = readSlowdown();
    Heartbeat alone;
    Watch watch{&alone};
    // plug-ins may crash
    if (!o->plugins.empty())
      if (const auto code = supervise(watch, arguments, makeSupervisorOptions(*o)))
        throw CLI::RuntimeError(*code);
    const Leaving leaving(*watch.heartbeat);
    const bool succeeded = run(*o, arguments, watch);
    const ExitCode code = succeeded ? ExitCode::kOk : ExitCode::kCheckFailed;
    watch.heartbeat->exitCode = static_cast<int>(code);
    if (!succeeded) throw CLI::RuntimeError(static_cast<int>(code));
  });
}

}  // namespace hlodbench
