#pragma once

#include <functional>
#include <string>

namespace hlodbench {

// Called by long work: what is being done, and the share of it that is finished, 0 to 1.
// May be called from one thread at a time only; an empty function is allowed and does nothing.
using Progress = std::function<void(const std::string& stage, double share)>;

}  // namespace hlodbench
