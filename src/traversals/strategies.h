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
// Limits to compare with. These throw std::invalid_argument without StrategyInputs::recording:
std::unique_ptr<Strategy> makeOracleStrategy(const StrategyInputs&);
std::unique_ptr<Strategy> makeIdealStrategy(const StrategyInputs&);
// and these do without.
std::unique_ptr<Strategy> makeNoneStrategy(const StrategyInputs&);
std::unique_ptr<Strategy> makeFullStrategy(const StrategyInputs&);

}  // namespace hlodbench
