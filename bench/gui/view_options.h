#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/render/renderer.h"
#include "preset.h"
#include "traversals/options.h"

namespace hlodbench {

// Everything that `hlodbench view` can be told.
struct ViewOptions {
  std::filesystem::path scene;
  std::filesystem::path session;  // shown at the start; empty: none
  std::filesystem::path record;   // where a recording is saved; empty: a new name in the folder
  std::filesystem::path folder = ".";  // of what is written
  std::filesystem::path cache;
  std::string size = "640x480";                  // of the view, pixels
  std::vector<std::string> strategies{"coh-b"};  // one, or two beside each other
  std::vector<std::filesystem::path> plugins;
  TraversalOptions traversal;
  std::string latency = "gl";
  double fovyDegrees = 50.0;
  double rate = 60.0;  // recorded poses a second
  bool noVsync = false;
  Preset preset = Preset::kPaper;
  FaceCulling faces = FaceCulling::kNone;
  std::uint64_t gpuMemory = kUnlimitedMemory;  // bytes
  BuildOptions build;
  bool glDebug = false;
  int frames = 0;                 // after which the window closes by itself; 0: never
  std::filesystem::path picture;  // of the window, kept when it closes; empty: none
};

}  // namespace hlodbench
