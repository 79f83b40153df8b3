#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace hlodbench {

// One function a sub-command: adds it with its options to the program. What it does throws
// InputError and GlUnavailable; main() turns them into exit codes. `arguments` is the command line.
void addListCommand(CLI::App& app, const std::vector<std::string>& arguments);
void addBuildCommand(CLI::App& app);
void addInfoCommand(CLI::App& app);
void addRunCommand(CLI::App& app, const std::vector<std::string>& arguments);
void addViewCommand(CLI::App& app);
void addTableCommand(CLI::App& app);
void addBiasCommand(CLI::App& app);
void addCompareCommand(CLI::App& app);

}  // namespace hlodbench
