#pragma once

#include <nlohmann/json.hpp>

#include "run.h"
#include "strategy_settings.h"

namespace hlodbench {

// The effective options, as stored in run.json. Reads the plug-ins, for their hashes.
nlohmann::json toJson(const RunOptions& options, const StrategySettings& settings,
                      const Lens& lens);

}  // namespace hlodbench
