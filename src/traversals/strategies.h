#pragma once

#include <memory>

#include "traversals/strategy.h"
#include "traversals/strategy_inputs.h"

namespace hlodbench {

// One function a strategy, each in the .cpp file of its name. What the inputs refer to must outlive
// the strategy.
std::unique_ptr<Strategy> makeBoolStrategy(const StrategyInputs&);
std::unique_ptr<Strategy> makeStopAndWaitStrategy(const StrategyInputs&);
std::unique_ptr<Strategy> makeSimpStrategy(const StrategyInputs&);
std::unique_ptr<Strategy> makeCohStrategy(const StrategyInputs&);

}  // namespace hlodbench
