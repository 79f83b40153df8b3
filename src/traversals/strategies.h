#pragma once

#include <memory>

#include "traversals/options.h"
#include "traversals/strategy.h"

namespace hlodbench {

// One function a strategy, each in the .cpp file of its name. The hierarchy must outlive the
// strategy.
std::unique_ptr<Strategy> makeBoolStrategy(const Hierarchy&, const TraversalOptions&);
std::unique_ptr<Strategy> makeStopAndWaitStrategy(const Hierarchy&, const TraversalOptions&);
std::unique_ptr<Strategy> makeSimpStrategy(const Hierarchy&, const TraversalOptions&);
std::unique_ptr<Strategy> makeCohStrategy(const Hierarchy&, const TraversalOptions&);

}  // namespace hlodbench
