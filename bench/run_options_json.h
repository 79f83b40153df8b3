#pragma once

#include <nlohmann/json.hpp>

#include "run.h"

namespace hlodbench {

// The effective options, as stored in run.json.
nlohmann::json toJson(const RunOptions& options, const Lens& lens);

}  // namespace hlodbench
