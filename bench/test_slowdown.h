#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace hlodbench {

// A test hook: stages of a frame that are made to take longer, to prove that what watches over
// times finds it and names the stage. Set by the environment variable kSlowdownVariable, never by
// an option; a run says so among its warnings.
struct Slowdown {
  // by how much of their own time, 0.05 for 5 %
  double draw = 0.0;       // drawing nodes
  double query = 0.0;      // issuing queries, asking for results and waiting for them
  double traversal = 0.0;  // the strategy itself

  [[nodiscard]] bool isAny() const { return draw > 0.0 || query > 0.0 || traversal > 0.0; }
};

inline constexpr const char* kSlowdownVariable = "HLODBENCH_TEST_SLOWDOWN";

// "" or stages with percents, 0 to 1000, such as "draw=5,traversal=10". Throws InputError.
Slowdown parseSlowdown(std::string_view text);
// That of the environment.
Slowdown readSlowdown();
// One line for a run's warnings; only for one that isAny().
std::string describeSlowdown(const Slowdown& slowdown);

// Keeps the processor busy for this share of `time`.
void spin(std::chrono::steady_clock::duration time, double share);

}  // namespace hlodbench
