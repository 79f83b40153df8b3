#include "traversals/registry.h"

#include <array>
#include <string>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

constexpr std::array kStrategies{
    StrategyInfo{"bool", "Bool", "coherent culling, refinement by SSE; the paper's reference image",
                 makeBoolStrategy},
    StrategyInfo{"sw-b", "SW(B)",
                 "hierarchical stop-and-wait, refinement by VMSSE; the ideal front",
                 makeStopAndWaitStrategy},
    StrategyInfo{"simp-b", "Simp*(B)",
                 "prediction by processing order, VMSSE (a reconstruction, see docs/deviations.md)",
                 makeSimpStrategy},
    StrategyInfo{"coh-b", "Coh(B)", "prediction by temporal coherence, VMSSE; the paper's method",
                 makeCohStrategy},
    StrategyInfo{"oracle", "Oracle", "limit: draws the recorded front of SW(B), with no query",
                 makeOracleStrategy, true},
    StrategyInfo{"ideal", "Ideal", "limit: Coh(B) with every prediction right, by SW(B)'s record",
                 makeIdealStrategy, true},
    StrategyInfo{"none", "SSE only", "limit: no occlusion culling, refinement by SSE and frustum",
                 makeNoneStrategy},
    StrategyInfo{"full", "Full", "limit: full resolution, every leaf in the frustum",
                 makeFullStrategy},
};

}  // namespace

std::span<const StrategyInfo> listStrategies() {
  return kStrategies;
}

const StrategyInfo& findStrategy(std::string_view name) {
  std::string known;
  for (const StrategyInfo& info : kStrategies) {
    if (info.name == name) return info;
    known += (known.empty() ? "" : ", ") + std::string(info.name);
  }
  throw InputError("--strategy: expected one of " + known + ", found '" + std::string(name) + "'");
}

}  // namespace hlodbench
