#include <fmt/format.h>

#include <memory>

#include "build_options.h"
#include "commands.h"
#include "gui/view.h"
#include "gui/view_options.h"
#include "hierarchy_store.h"
#include "hlod/core/error.h"
#include "latency.h"
#include "number_range.h"
#include "plugin_option.h"
#include "renderer_options.h"
#include "traversal_option.h"

namespace hlodbench {
namespace {

void addWindowOptions(CLI::App& sub, ViewOptions& o) {
  sub.add_option("--size", o.size, "of the view at the start, WIDTHxHEIGHT, pixels")
      ->capture_default_str();
  sub.add_option("--fov", o.fovyDegrees, "vertical field of view at the start, degrees")
      ->capture_default_str()
      ->check(makeNumberRange(10.0, 120.0));
  sub.add_flag("--no-vsync", o.noVsync, "do not wait for the screen's refresh");
  CLI::Option* frames =
      sub.add_option("--frames", o.frames,
                     "close the window after so many frames, for scripts; 0: when the user does")
          ->capture_default_str()
          ->check(CLI::Range(0, 1'000'000));
  sub.add_option("--picture", o.picture,
                 "with --frames: keep the window's last frame, panels included, as a picture")
      ->needs(frames);
  sub.add_flag("--gl-debug", o.glDebug, "stop at every OpenGL error");
}

void addSessionOptions(CLI::App& sub, ViewOptions& o) {
  sub.add_option("--session", o.session, "camera session (.json) to show at the start");
  sub.add_option("--record", o.record,
                 "file that a recording is saved in; default: SCENE.session.json in --folder, with "
                 "a number where that is there");
  sub.add_option("--folder", o.folder, "of recordings, pictures and comparisons")
      ->capture_default_str();
  sub.add_option("--rate", o.rate, "poses recorded a second, however fast frames are shown")
      ->capture_default_str()
      ->check(makeNumberRange(1.0, 1000.0));
}

}  // namespace

void addViewCommand(CLI::App& app) {
  auto o = std::make_shared<ViewOptions>();
  o->cache = getDefaultCacheFolder();
  CLI::App* sub = app.add_subcommand(
      "view", "Look at a scene in a window, record a session, watch strategies at work");
  sub->add_option("scene", o->scene, "hierarchy (.hlod), or a scene or mesh file to build it from")
      ->required();
  addSessionOptions(*sub, *o);
  sub->add_option("--strategy", o->strategies,
                  "strategy at the start, see `hlodbench list`; two, comma-separated, split the "
                  "window between them")
      ->delimiter(',')
      ->expected(1, 2)
      ->capture_default_str();
  addPluginOption(*sub, o->plugins);
  sub->add_option("--latency", o->latency, "when query results are there, as for `hlodbench run`")
      ->capture_default_str();
  addTraversalOptions(*sub, o->traversal);
  addWindowOptions(*sub, *o);
  addMemoryOption(*sub, o->gpuMemory);
  addFacesOption(*sub, o->faces);
  sub->add_option("--cache", o->cache, "folder of hierarchies built from a scene file")
      ->capture_default_str();
  addPresetOption(*sub, o->preset);
  addBuildOptions(*sub, o->build);
  sub->footer("The ? key shows the keys of the window.");
  sub->callback([o, sub] {
    refuseBuildOptions(*sub, o->scene);
    applyPreset(o->preset, *sub, o->build);
    parseLatency(o->latency);
    if (!view(*o)) throw CLI::RuntimeError(static_cast<int>(ExitCode::kBadInput));
  });
}

}  // namespace hlodbench
