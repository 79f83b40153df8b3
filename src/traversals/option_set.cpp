#include "traversals/option_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

using plugin::OptionInfo;
using plugin::OptionType;

constexpr double kLargestInt = 9007199254740992.0;  // 2^53: a double has every integer up to it

std::vector<std::string> splitChoices(const char* choices) {
  std::vector<std::string> names(1);
  for (const char* c = choices; *c != '\0'; ++c)
    if (*c == ',')
      names.emplace_back();
    else
      names.back() += *c;
  return names;
}

std::optional<double> parseNumber(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Nothing for a text that the option does not take.
std::optional<double> parse(const OptionInfo& info, std::string_view text) {
  if (info.type == OptionType::kBool) {
    if (text == "on" || text == "off") return text == "on" ? 1.0 : 0.0;
    return std::nullopt;
  }
  if (info.type == OptionType::kChoice) {
    const std::vector<std::string> names = splitChoices(info.choices);
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) return std::nullopt;
    return static_cast<double>(found - names.begin());
  }
  const std::optional<double> value = parseNumber(text);
  if (!value || !(*value >= info.least && *value <= info.most)) return std::nullopt;
  if (info.type == OptionType::kInt && *value != std::floor(*value)) return std::nullopt;
  return value;
}

// What is wrong with one declaration.
std::string checkInfo(const OptionInfo& info) {
  if (info.name == nullptr || !isIdentifier(info.name))
    return fmt::format("expected an option's name of a-z, 0-9, - and _, found '{}'",
                       info.name == nullptr ? "" : info.name);
  const auto wrong = [&](const char* what) {
    return fmt::format("option '{}': {}", info.name, what);
  };
  if (info.meaning == nullptr || *info.meaning == '\0') return wrong("expected a meaning");
  switch (info.type) {
    case OptionType::kBool:
      return "";
    case OptionType::kChoice: {
      if (info.choices == nullptr) return wrong("expected choices");
      const std::vector<std::string> names = splitChoices(info.choices);
      for (const std::string& name : names)
        if (!isIdentifier(name) || std::count(names.begin(), names.end(), name) > 1)
          return wrong("expected choices that are names, each once, as in 'last,mean'");
      return info.preset == 0.0 ? "" : wrong("expected the first choice as default");
    }
    case OptionType::kInt:
      if (info.preset != std::floor(info.preset)) return wrong("expected an integer as default");
      [[fallthrough]];
    case OptionType::kDouble:
      if (!(info.least >= -kLargestInt && info.most <= kLargestInt && info.least <= info.most))
        return wrong("expected a range from least to most, at most 2^53 either way");
      if (!(info.preset >= info.least && info.preset <= info.most))
        return wrong("expected a default within its range");
      return "";
  }
  return wrong("expected a type that there is");
}

}  // namespace

OptionSet::OptionSet(std::span<const OptionInfo> infos) : infos_(infos) {
  for (const OptionInfo& info : infos) values_.push_back(info.preset);
}

void OptionSet::set(std::string_view strategy, std::string_view name, std::string_view text) {
  std::string known;
  for (std::size_t i = 0; i < infos_.size(); ++i) {
    const OptionInfo& info = infos_[i];
    known += (i == 0 ? "" : ", ") + std::string(info.name);
    if (name != info.name) continue;
    const std::optional<double> value = parse(info, text);
    if (!value)
      throw InputError(fmt::format("--set {}.{}: expected {}, found '{}'", strategy, name,
                                   describeRange(info), text));
    values_[i] = *value;
    return;
  }
  throw InputError(fmt::format(
      "--set {}.{}: expected {}", strategy, name,
      known.empty() ? "an option, but the strategy has none" : "one of its options, " + known));
}

plugin::OptionValues OptionSet::values() const {
  return {infos_.data(), values_.data(), static_cast<std::uint32_t>(values_.size())};
}

std::vector<std::string> OptionSet::texts() const {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < infos_.size(); ++i)
    texts.push_back(fmt::format("{}={}", infos_[i].name, describeValue(infos_[i], values_[i])));
  return texts;
}

std::string describeRange(const OptionInfo& info) {
  switch (info.type) {
    case OptionType::kInt:
      return fmt::format("an integer from {:.0f} to {:.0f}", info.least, info.most);
    case OptionType::kDouble:
      return fmt::format("a number from {:.16g} to {:.16g}", info.least, info.most);
    case OptionType::kBool:
      return "on or off";
    case OptionType::kChoice:
      return fmt::format("one of {}", fmt::join(splitChoices(info.choices), ", "));
  }
  return "";
}

std::string describeValue(const OptionInfo& info, double value) {
  if (info.type == OptionType::kBool) return value != 0.0 ? "on" : "off";
  if (info.type == OptionType::kChoice)
    return splitChoices(info.choices).at(static_cast<std::size_t>(value));
  return fmt::format("{:.16g}", value);
}

std::string checkOptionInfos(std::span<const OptionInfo> infos) {
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (std::string wrong = checkInfo(infos[i]); !wrong.empty()) return wrong;
    for (std::size_t j = 0; j < i; ++j)
      if (std::string_view(infos[i].name) == infos[j].name)
        return fmt::format("option '{}': expected once, found twice", infos[i].name);
  }
  return "";
}

bool isIdentifier(std::string_view text) {
  const auto isLetter = [](char c) { return c >= 'a' && c <= 'z'; };
  return !text.empty() && isLetter(text.front()) &&
         std::all_of(text.begin(), text.end(), [&](char c) {
           return isLetter(c) || (c >= '0' && c <= '9') || c == '-' || c == '_';
         });
}

}  // namespace hlodbench
