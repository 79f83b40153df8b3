#pragma once

#include <hlodbench/options.h>

#include <memory>
#include <span>
#include <string_view>

#include "traversals/strategies.h"

namespace hlodbench {

struct StrategyInfo {
  std::string_view name;         // on the command line and in files
  std::string_view label;        // in tables, as the paper prints it
  std::string_view description;  // one line
  std::unique_ptr<Strategy> (*create)(const StrategyInputs&);
  std::span<const plugin::OptionInfo> options = {};  // of its own, set by --set NAME.OPTION=VALUE

  // What the inputs refer to must outlive the strategy; the values of options need not.
  [[nodiscard]] std::unique_ptr<Strategy> make(const StrategyInputs& inputs) const;
};

// Every strategy, in the order of the paper's Table 1.
std::span<const StrategyInfo> listStrategies();

// Throws InputError, listing the known names, for one that is not known.
const StrategyInfo& findStrategy(std::string_view name);

}  // namespace hlodbench
