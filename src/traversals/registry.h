#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "traversals/strategies.h"

namespace hlodbench {

struct StrategyInfo {
  std::string_view name;         // on the command line and in files
  std::string_view label;        // in tables, as the paper prints it
  std::string_view description;  // one line
  std::unique_ptr<Strategy> (*make)(const StrategyInputs&);
  bool needsRecording = false;  // make() throws without StrategyInputs::recording
};

// Every strategy: those of the paper in the order of its Table 1, then limits to compare with.
std::span<const StrategyInfo> listStrategies();

// Throws InputError, listing the known names, for one that is not known.
const StrategyInfo& findStrategy(std::string_view name);

}  // namespace hlodbench
