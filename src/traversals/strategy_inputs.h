#pragma once

#include "hlod/tree/hierarchy.h"
#include "traversals/options.h"

namespace hlodbench {

// What a strategy is made from. What it refers to must outlive the strategy.
struct StrategyInputs {
  const Hierarchy& hierarchy;
  TraversalOptions options = {};
};

}  // namespace hlodbench
