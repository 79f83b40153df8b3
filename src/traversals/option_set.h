#pragma once

#include <hlodbench/options.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hlodbench {

// The values of one strategy's options: the defaults, until they are set.
class OptionSet {
 public:
  // The infos must outlive this.
  explicit OptionSet(std::span<const plugin::OptionInfo> infos);

  // Takes a value as it is written: 3, 0.25, on or off, the name of a choice. Throws InputError
  // "--set STRATEGY.NAME: expected ..., found 'text'", also for a name that there is none of.
  void set(std::string_view strategy, std::string_view name, std::string_view text);

  [[nodiscard]] plugin::OptionValues values() const;
  // What set() takes to come to these values, an option each: "NAME=VALUE".
  [[nodiscard]] std::vector<std::string> texts() const;

 private:
  std::span<const plugin::OptionInfo> infos_;
  std::vector<double> values_;
};

// What an option takes: "an integer from 1 to 8", "a number from 0 to 1", "on or off", "one of
// last, mean".
std::string describeRange(const plugin::OptionInfo& info);

// A value as set() takes it.
std::string describeValue(const plugin::OptionInfo& info, double value);

// Names what is wrong with the declarations themselves, as of a plug-in: a name that is no name or
// there twice, a default out of range, a missing text. Empty if nothing is.
std::string checkOptionInfos(std::span<const plugin::OptionInfo> infos);

// Lower-case letters, digits, - and _, from a letter on: of strategies and options.
bool isIdentifier(std::string_view text);

}  // namespace hlodbench
