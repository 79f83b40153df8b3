#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <vector>

namespace hlodbench {

// Adds --plugin, which may be repeated.
inline void addPluginOption(CLI::App& command, std::vector<std::filesystem::path>& plugins) {
  command
      .add_option(
          "--plugin", plugins,
          "shared library with strategies, see docs/writing-a-predictor.md; may be repeated")
      ->allow_extra_args(false);
}

}  // namespace hlodbench
