#include "test_slowdown.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

constexpr double kMostPercent = 1000.0;

struct Stage {
  std::string_view name;
  double Slowdown::*share;
};

constexpr Stage kStages[] = {
    {"draw", &Slowdown::draw}, {"query", &Slowdown::query}, {"traversal", &Slowdown::traversal}};

[[noreturn]] void fail(std::string_view part) {
  throw InputError(fmt::format(
      "{}: expected stages (draw, query, traversal) with percents from 0 to {:g}, such as "
      "draw=5,query=10, found '{}'",
      kSlowdownVariable, kMostPercent, part));
}

void setStage(Slowdown& slowdown, std::string_view part) {
  const std::size_t sign = part.find('=');
  if (sign == std::string_view::npos) fail(part);
  const std::string_view number = part.substr(sign + 1);
  double percent = 0.0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), percent);
  if (error != std::errc() || end != number.data() + number.size() || !(percent >= 0.0) ||
      percent > kMostPercent)
    fail(part);
  for (const Stage& stage : kStages)
    if (stage.name == part.substr(0, sign)) {
      slowdown.*stage.share = percent / 100.0;
      return;
    }
  fail(part);
}

}  // namespace

Slowdown parseSlowdown(std::string_view text) {
  Slowdown slowdown;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    setStage(slowdown, text.substr(0, comma));
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
    if (text.empty()) fail("");
  }
  return slowdown;
}

Slowdown readSlowdown() {
  const char* text = std::getenv(kSlowdownVariable);
  return parseSlowdown(text != nullptr ? text : "");
}

std::string describeSlowdown(const Slowdown& slowdown) {
  std::string stages;
  for (const Stage& stage : kStages)
    if (slowdown.*stage.share > 0.0)
      stages += fmt::format("{}{} by {:g} %", stages.empty() ? "" : ", ", stage.name,
                            100.0 * (slowdown.*stage.share));
  return fmt::format("slowed down for a test ({}): {}", kSlowdownVariable, stages);
}

void spin(std::chrono::steady_clock::duration time, double share) {
  const auto end = std::chrono::steady_clock::now() +
                   std::chrono::duration_cast<std::chrono::steady_clock::duration>(share * time);
  while (std::chrono::steady_clock::now() < end) {
  }
}

}  // namespace hlodbench
