#include "traversals/registry.h"

#include <array>
#include <string>

#include "hlod/core/error.h"
#include "traversals/option_set.h"

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
};

}  // namespace

std::unique_ptr<Strategy> StrategyInfo::make(const StrategyInputs& inputs) const {
  const OptionSet defaults(options);
  return create(
      {inputs.hierarchy, inputs.options, inputs.own.size() == 0 ? defaults.values() : inputs.own});
}

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
