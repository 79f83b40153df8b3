#pragma once

#include <hlodbench/options.h>

#include "hlod/tree/hierarchy.h"
#include "traversals/options.h"

namespace hlodbench {

// What a strategy is made from. What it refers to must outlive the strategy.
struct StrategyInputs {
  const Hierarchy& hierarchy;
  TraversalOptions options = {};
  // of its own options, StrategyInfo::options; without any, StrategyInfo::make() takes the defaults
  plugin::OptionValues own = {};
};

}  // namespace hlodbench
