#pragma once

#include <hlodbench/options.h>

#include <stdexcept>

#include "hlod/tree/hierarchy.h"
#include "traversals/front_recording.h"
#include "traversals/options.h"

namespace hlodbench {

// What a strategy is made from. What it refers to must outlive the strategy.
struct StrategyInputs {
  const Hierarchy& hierarchy;
  TraversalOptions options = {};
  // Of SW(B) with the same hierarchy, options and session; null where no strategy asks for it
  // (StrategyInfo::needsRecording). Frames may be added to it while it is used, each before it is
  // rendered.
  const FrontRecording* recording = nullptr;
  // of its own options, StrategyInfo::options; without any, StrategyInfo::make() takes the defaults
  plugin::OptionValues own = {};
};

// The recording, for a strategy that cannot do without. Throws std::invalid_argument for none.
inline const FrontRecording& requireRecording(const StrategyInputs& inputs) {
  if (inputs.recording == nullptr)
    throw std::invalid_argument("StrategyInputs: this strategy needs a recording, found none");
  return *inputs.recording;
}

}  // namespace hlodbench
