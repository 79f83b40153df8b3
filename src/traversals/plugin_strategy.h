#pragma once

#include <hlodbench/plugin.h>

#include <memory>

#include "traversals/strategy.h"
#include "traversals/strategy_inputs.h"

namespace hlodbench {

// Makes a strategy that is described in the form of a plug-in: its predictor in the coherent
// traversal, or the strategy itself with everything it asks for checked. Throws what its
// constructor throws.
std::unique_ptr<Strategy> makePluginStrategy(const plugin::StrategyDescriptor& descriptor,
                                             const StrategyInputs& inputs);

}  // namespace hlodbench
