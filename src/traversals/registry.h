#pragma once

#include <hlodbench/plugin.h>

#include <memory>
#include <span>
#include <string_view>

#include "traversals/strategies.h"

namespace hlodbench {

struct StrategyInfo {
  std::string_view name;         // on the command line and in files
  std::string_view label;        // in tables, as the paper prints it
  std::string_view description;  // one line
  std::unique_ptr<Strategy> (*create)(const StrategyInputs&);
  std::span<const plugin::OptionInfo> options = {};  // of its own, set by --set NAME.OPTION=VALUE
  // of one in the form of a plug-in, which is made from it; `create` is null then
  const plugin::StrategyDescriptor* descriptor = nullptr;
  bool needsRecording = false;  // make() throws without StrategyInputs::recording

  // What the inputs refer to must outlive the strategy; the values of options need not.
  [[nodiscard]] std::unique_ptr<Strategy> make(const StrategyInputs& inputs) const;
};

// Every strategy of the tree: those of the paper in the order of its Table 1, then limits to
// compare with, then the others.
std::span<const StrategyInfo> listStrategies();

// Throws InputError, listing the known names, for one that is not known.
const StrategyInfo& findStrategy(std::string_view name,
                                 std::span<const StrategyInfo> strategies = listStrategies());

// The descriptor must outlive what is returned.
StrategyInfo describeStrategy(const plugin::StrategyDescriptor& descriptor);

}  // namespace hlodbench
