#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>

#include "hlod/build/hierarchy_builder.h"

namespace hlodbench {

// A size in bytes: a number, alone or with K, M or G of 1024. Throws InputError, which names the
// option.
std::uint64_t parseMemory(const std::string& option, const std::string& text);

// Adds --max-triangles, --simplifier, --error-samples, --error, --normals, --threads and --memory.
void addBuildOptions(CLI::App& command, BuildOptions& options);

// Throws InputError when one of them was given although `scene` is a hierarchy that is built.
void refuseBuildOptions(const CLI::App& command, const std::filesystem::path& scene);

}  // namespace hlodbench
