#pragma once

#include <CLI/CLI.hpp>

#include "hlod/build/hierarchy_builder.h"

namespace hlodbench {

// Adds --max-triangles, --simplifier, --error-samples and --threads.
void addBuildOptions(CLI::App& command, BuildOptions& options);

}  // namespace hlodbench
