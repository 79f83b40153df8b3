#include "case_plan.h"

#include <random>
#include <utility>

namespace hlodbench {

std::vector<CaseKey> planCases(const std::vector<std::string>& strategies, int repetitions,
                               std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<CaseKey> plan;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    std::vector<std::string> order = strategies;
    // Fisher-Yates by hand: std::shuffle differs between standard libraries
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    for (const std::string& strategy : order) plan.push_back({strategy, repetition});
  }
  return plan;
}

}  // namespace hlodbench
