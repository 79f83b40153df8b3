#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "metrics/result.h"

namespace hlodbench {

// What two runs differ in, in words.
struct RunDifferences {
  std::vector<std::string> refusals;  // what makes a comparison senseless, and is not allowed
  std::vector<std::string> notes;     // everything else, and what is allowed
  std::optional<std::string> timesObstacle;  // why times cannot be compared
  bool sameSession = true;                   // frame i of one is frame i of the other
};

// What --allow may name: what a comparison is refused for (scene, session, size, tau), and what
// times are left out for (machine).
const std::vector<std::string>& listAllowances();

RunDifferences findDifferences(const RunResult& a, const RunResult& b,
                               const std::set<std::string>& allowed);

// Why counts of this run are not the same in every run; nothing where they are.
std::optional<std::string> findCountObstacle(const RunResult& run);

}  // namespace hlodbench
