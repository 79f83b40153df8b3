#pragma once

#include <CLI/CLI.hpp>

#include "hlod/build/hierarchy_builder.h"

namespace hlodbench {

// A set of defaults.
enum class Preset {
  kPaper,  // of Charalambos et al. (section 5): what every number of theirs is compared with
  kBest    // the least work for a picture of some quality, see docs/performance.md
};

// Adds --preset.
void addPresetOption(CLI::App& command, Preset& preset);

// Sets what the preset says of building where the command line says nothing.
void applyPreset(Preset preset, const CLI::App& command, BuildOptions& options);

// Pixels of error that --preset best allows: root mean square, not the largest.
inline constexpr double kBestTau = 0.25;

}  // namespace hlodbench
