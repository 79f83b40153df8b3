#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

namespace hlodbench::plugin {

enum class OptionType : std::uint32_t { kInt, kDouble, kBool, kChoice };

// One option of a strategy. Its value is set by `--set STRATEGY.NAME=VALUE`, checked before
// anything runs, and stored in run.json. Make one by the functions below.
struct OptionInfo {
  const char* name;  // lower-case letters, digits, - and _, from a letter on
  OptionType type;
  double least, most;   // the range of a number, both ends included; at most 2^53 either way
  double preset;        // the default: a number, 0 or 1, the place of a choice from 0
  const char* choices;  // of a choice: its names, "last,mean"; else nullptr
  const char* meaning;  // one line, with the unit
};

constexpr OptionInfo intOption(const char* name, std::int64_t least, std::int64_t most,
                               std::int64_t preset, const char* meaning) {
  return {name,
          OptionType::kInt,
          static_cast<double>(least),
          static_cast<double>(most),
          static_cast<double>(preset),
          nullptr,
          meaning};
}
constexpr OptionInfo numberOption(const char* name, double least, double most, double preset,
                                  const char* meaning) {
  return {name, OptionType::kDouble, least, most, preset, nullptr, meaning};
}
constexpr OptionInfo boolOption(const char* name, bool preset, const char* meaning) {
  return {name, OptionType::kBool, 0.0, 1.0, preset ? 1.0 : 0.0, nullptr, meaning};
}
// The first of the comma-separated names is the default.
constexpr OptionInfo choiceOption(const char* name, const char* choices, const char* meaning) {
  return {name, OptionType::kChoice, 0.0, 0.0, 0.0, choices, meaning};
}

// The values of a strategy's options: what its constructor gets. Asking for an option that was not
// declared, or by another type, throws std::logic_error.
class OptionValues {
 public:
  OptionValues() = default;
  // values: one an option, as OptionInfo::preset. Both must outlive this.
  OptionValues(const OptionInfo* infos, const double* values, std::uint32_t count)
      : infos_(infos), values_(values), count_(count) {}

  [[nodiscard]] std::uint32_t size() const { return count_; }
  [[nodiscard]] std::int64_t integer(const char* name) const {
    return static_cast<std::int64_t>(values_[find(name, OptionType::kInt)]);
  }
  [[nodiscard]] double number(const char* name) const {
    return values_[find(name, OptionType::kDouble)];
  }
  [[nodiscard]] bool flag(const char* name) const {
    return values_[find(name, OptionType::kBool)] != 0.0;
  }
  // The name of the choice.
  [[nodiscard]] std::string choice(const char* name) const {
    const std::uint32_t i = find(name, OptionType::kChoice);
    const char* begin = infos_[i].choices;
    for (double left = values_[i]; left > 0.0; left -= 1.0) begin = std::strchr(begin, ',') + 1;
    const char* const end = std::strchr(begin, ',');
    return end == nullptr ? std::string(begin) : std::string(begin, end);
  }

 private:
  [[nodiscard]] std::uint32_t find(const char* name, OptionType type) const {
    for (std::uint32_t i = 0; i < count_; ++i)
      if (std::strcmp(infos_[i].name, name) == 0 && infos_[i].type == type) return i;
    throw std::logic_error("asked for option '" + std::string(name) +
                           "', which is not declared, or with another type");
  }

  const OptionInfo* infos_ = nullptr;
  const double* values_ = nullptr;
  std::uint32_t count_ = 0;
};

}  // namespace hlodbench::plugin
