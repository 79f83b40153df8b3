#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "metrics/result.h"

namespace hlodbench {

// The replays of a run in the order in which they happen: repetition by repetition, within each the
// strategies in an order drawn at random, so that slow drifts of the machine hit all alike.
std::vector<CaseKey> planCases(const std::vector<std::string>& strategies, int repetitions,
                               std::uint64_t seed);

}  // namespace hlodbench
