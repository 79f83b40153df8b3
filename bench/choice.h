#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hlod/core/error.h"

namespace hlodbench {

// Adds an option that takes one of a few names; the help shows them and the name of the present
// value. Another name is an InputError that lists them.
template <typename T>
CLI::Option* addChoice(CLI::App& command, const std::string& option, T& value,
                       const std::vector<std::pair<std::string, T>>& choices,
                       const std::string& help) {
  std::string names;
  std::string present;
  for (const auto& [name, choice] : choices) {
    names += (names.empty() ? "" : ", ") + name;
    if (choice == value) present = name;
  }
  return command
      .add_option_function<std::string>(
          option,
          [&value, choices, option, names](const std::string& text) {
            for (const auto& [name, choice] : choices)
              if (name == text) {
                value = choice;
                return;
              }
            throw InputError(
                fmt::format("{}: expected one of {}, found '{}'", option, names, text));
          },
          fmt::format("{} ({})", help, names))
      ->default_str(present);
}

}  // namespace hlodbench
