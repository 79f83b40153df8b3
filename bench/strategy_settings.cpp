#include "strategy_settings.h"

#include <fmt/format.h>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

using plugin::OptionInfo;
using plugin::OptionType;

nlohmann::json toJsonValue(const OptionInfo& info, const plugin::OptionValues& values) {
  switch (info.type) {
    case OptionType::kInt:
      return values.integer(info.name);
    case OptionType::kDouble:
      return values.number(info.name);
    case OptionType::kBool:
      return values.flag(info.name);
    case OptionType::kChoice:
      return values.choice(info.name);
  }
  return {};
}

}  // namespace

StrategySettings::StrategySettings(const std::vector<const StrategyInfo*>& strategies,
                                   const std::vector<std::string>& settings) {
  std::string known;
  for (const StrategyInfo* info : strategies) {
    entries_.emplace(info->name, Entry{info, OptionSet(info->options)});
    known += (known.empty() ? "" : ", ") + std::string(info->name);
  }
  for (const std::string& text : settings) {
    const std::size_t equals = text.find('=');
    const std::size_t dot = text.substr(0, equals).find('.');
    if (equals == std::string::npos || dot == std::string::npos)
      throw InputError(fmt::format(
          "--set: expected STRATEGY.OPTION=VALUE like mine.decay=0.5, found '{}'", text));
    const std::string strategy = text.substr(0, dot);
    const auto found = entries_.find(strategy);
    if (found == entries_.end())
      throw InputError(fmt::format("--set {}: expected a strategy that runs, {}, found '{}'",
                                   text.substr(0, equals), known, strategy));
    found->second.set.set(strategy, text.substr(dot + 1, equals - dot - 1),
                          text.substr(equals + 1));
  }
}

plugin::OptionValues StrategySettings::of(std::string_view strategy) const {
  return entries_.find(strategy)->second.set.values();
}

nlohmann::json StrategySettings::toJson() const {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, entry] : entries_)
    for (const OptionInfo& info : entry.info->options)
      json[name][info.name] = toJsonValue(info, entry.set.values());
  return json;
}

std::string describeOptions(const StrategyInfo& info) {
  std::string text;
  for (const OptionInfo& option : info.options)
    text +=
        fmt::format("    --set {}.{}=: {}; {}, default {}\n", info.name, option.name,
                    option.meaning, describeRange(option), describeValue(option, option.preset));
  return text;
}

}  // namespace hlodbench
