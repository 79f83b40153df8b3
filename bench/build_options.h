#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "hlod/build/hierarchy_builder.h"

namespace hlodbench {

// Adds --max-triangles, --simplifier, --error-samples, --error, --normals, --threads and --memory.
void addBuildOptions(CLI::App& command, BuildOptions& options);

// Throws InputError when one of them was given although `scene` is a hierarchy that is built.
void refuseBuildOptions(const CLI::App& command, const std::filesystem::path& scene);

}  // namespace hlodbench
