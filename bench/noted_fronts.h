#pragma once

#include <filesystem>
#include <vector>

#include "picture_pass.h"

namespace hlodbench {

// The fronts that pictures will be drawn of, in a file: what one worker noted and the next one
// draws. Reading gives what was written to the last bit. Both throw InputError naming the file.
void writeNotedFronts(const std::filesystem::path& file, const std::vector<StrategyFronts>& fronts);
std::vector<StrategyFronts> readNotedFronts(const std::filesystem::path& file);

}  // namespace hlodbench
