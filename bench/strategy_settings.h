#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "traversals/option_set.h"
#include "traversals/registry.h"

namespace hlodbench {

// The values of the strategies' own options in a run.
class StrategySettings {
 public:
  // strategies: those that run, which must outlive this. settings: texts STRATEGY.OPTION=VALUE; of
  // one option the last holds. Throws InputError for another form, a strategy that does not run, an
  // option that it does not have, a value that it does not take.
  StrategySettings(const std::vector<const StrategyInfo*>& strategies,
                   const std::vector<std::string>& settings);

  [[nodiscard]] plugin::OptionValues of(std::string_view strategy) const;

  // {"STRATEGY": {"OPTION": value}} of those that have options; values are numbers, true or false,
  // names of choices.
  [[nodiscard]] nlohmann::json toJson() const;

 private:
  struct Entry {
    const StrategyInfo* info;
    OptionSet set;
  };
  std::map<std::string, Entry, std::less<>> entries_;
};

// One line an option of a strategy, with its range and default, for `list` and the help; ""
// without.
std::string describeOptions(const StrategyInfo& info);

}  // namespace hlodbench
