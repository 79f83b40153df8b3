#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hlod/build/hierarchy_builder.h"
#include "image_selection.h"
#include "latency.h"
#include "picture_pass.h"
#include "preset.h"
#include "replay.h"
#include "supervisor.h"
#include "traversals/options.h"

namespace hlodbench {

// Everything `hlodbench run` can be told; the JSON it writes stores the same.
struct RunOptions {
  std::filesystem::path scene, session, out;
  std::filesystem::path cache;
  std::vector<std::string> strategies{"bool", "sw-b", "simp-b", "coh-b"};
  int repetitions = 1;
  std::string context = "auto";
  bool glDebug = false;
  std::string size;  // "WxH", empty: the session's viewport
  Preset preset = Preset::kPaper;
  FaceCulling faces = FaceCulling::kNone;
  TraversalOptions traversal;
  QueryFaces queryFaces = QueryFaces::kFront;
  std::vector<std::string> settings;           // STRATEGY.OPTION=VALUE, see StrategySettings
  std::vector<std::filesystem::path> plugins;  // shared libraries with more strategies
  double frameTimeout = 30.0;                  // seconds, with plug-ins; see SupervisorOptions
  std::string latency = "gl";
  std::optional<int> turns;  // descriptor of a socket, see Turns; none: no turns are taken
  int turnFrames = 8;        // in a turn
  std::filesystem::path trace;
  std::uint64_t seed =
      1;  // of the order of the strategies in each repetition, and of --images N, --explain N
  std::uint64_t gpuMemory = kUnlimitedMemory;  // bytes for nodes' geometry
  ReplayOptions replay;
  ImageSelection images;  // frames kept as pictures, drawn again in an untimed pass
  ImageSelection explain{ImageSelection::Kind::kNone, 0, {}};  // frames with counters that explain
  PictureOptions pictures;
  BuildOptions build;
};

// Replays the session with every strategy, `repetitions` times, in random order within each
// repetition, and writes the result folder; see docs/results.md for what is in it. What is finished
// is written at once, so that an interrupted run leaves it. Returns false when a case failed or the
// run was interrupted. Throws InputError and GlUnavailable. `watch` is told where the run is, and
// says what an earlier process did of it.
bool run(const RunOptions& options, const std::vector<std::string>& arguments, const Watch& watch);

// What a supervisor of the run has to know.
SupervisorOptions makeSupervisorOptions(const RunOptions& options);

}  // namespace hlodbench
