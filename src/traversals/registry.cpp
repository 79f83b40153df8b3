#include "traversals/registry.h"

#include <array>
#include <initializer_list>
#include <string>
#include <vector>

#include "hlod/core/error.h"
#include "traversals/option_set.h"
#include "traversals/plugin_strategy.h"

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
    StrategyInfo{"oracle",
                 "Oracle",
                 "limit: draws the recorded front of SW(B), with no query",
                 makeOracleStrategy,
                 {},
                 nullptr,
                 true},
    StrategyInfo{"ideal",
                 "Ideal",
                 "limit: Coh(B) with every prediction right, by SW(B)'s record",
                 makeIdealStrategy,
                 {},
                 nullptr,
                 true},
    StrategyInfo{"none", "SSE only", "limit: no occlusion culling, refinement by SSE and frustum",
                 makeNoneStrategy},
    StrategyInfo{"full", "Full", "limit: full resolution, every leaf in the frustum",
                 makeFullStrategy},
};

}  // namespace

// The strategies of a file that is written like a plug-in, in which HLODBENCH_PLUGIN(NAME, ...)
// stands. No header declares them, so that a new file needs one line, below.
#define PLUGIN_FILE(name)                                  \
  [] {                                                     \
    extern plugin::StrategyList listStrategiesOf_##name(); \
    return listStrategiesOf_##name();                      \
  }

namespace {

std::vector<StrategyInfo> joinStrategies(
    std::initializer_list<plugin::StrategyList (*)()> pluginFiles) {
  std::vector<StrategyInfo> all(kStrategies.begin(), kStrategies.end());
  for (const auto listFile : pluginFiles) {
    const plugin::StrategyList list = listFile();
    for (std::uint32_t i = 0; i < list.count; ++i)
      all.push_back(describeStrategy(list.strategies[i]));
  }
  return all;
}

}  // namespace

std::span<const StrategyInfo> listStrategies() {
  static const std::vector<StrategyInfo> strategies = joinStrategies({
      // one line a file: PLUGIN_FILE(name),
      PLUGIN_FILE(reuse_b),  // reuse_strategy.cpp
  });
  return strategies;
}

const StrategyInfo& findStrategy(std::string_view name, std::span<const StrategyInfo> strategies) {
  std::string known;
  for (const StrategyInfo& info : strategies) {
    if (info.name == name) return info;
    known += (known.empty() ? "" : ", ") + std::string(info.name);
  }
  throw InputError("--strategy: expected one of " + known + ", found '" + std::string(name) + "'");
}

std::unique_ptr<Strategy> StrategyInfo::make(const StrategyInputs& inputs) const {
  const OptionSet defaults(options);
  StrategyInputs all = inputs;
  if (all.own.size() == 0) all.own = defaults.values();
  return descriptor != nullptr ? makePluginStrategy(*descriptor, all) : create(all);
}

StrategyInfo describeStrategy(const plugin::StrategyDescriptor& d) {
  return {d.name, d.label, d.description, nullptr, {d.options, d.optionCount}, &d};
}

}  // namespace hlodbench
