#include <fmt/format.h>

#include <cmath>

#include "compare_text.h"
#include "markdown.h"

namespace hlodbench {
namespace {

constexpr const char* kNone = "–";

std::string formatValue(double value) {
  return std::abs(value) >= 1e4 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string formatValue(const std::optional<double>& value) {
  return value ? formatValue(*value) : kNone;
}

std::string formatSigned(double value) {
  const std::string text = formatValue(value);
  return value > 0.0 ? "+" + text : text;
}

std::string formatInterval(const std::optional<Interval>& interval) {
  if (!interval) return kNone;
  std::string text = formatSigned(interval->value);
  if (interval->low && interval->high && *interval->low != *interval->high)
    text += fmt::format(" [{}, {}]", formatSigned(*interval->low), formatSigned(*interval->high));
  return text;
}

std::string formatRelative(const std::optional<Interval>& interval) {
  if (!interval) return kNone;
  std::string text = fmt::format("{:+.2f} %", 100.0 * interval->value);
  if (interval->low && interval->high && *interval->low != *interval->high)
    text += fmt::format(" [{:+.2f}, {:+.2f}]", 100.0 * *interval->low, 100.0 * *interval->high);
  return text;
}

std::string formatPair(const ComparePair& pair) {
  std::vector<std::vector<std::string>> rows;
  for (const CompareRow& row : pair.rows)
    rows.push_back({row.unit.empty() ? row.label : fmt::format("{}, {}", row.label, row.unit),
                    formatValue(row.a), formatValue(row.b), formatInterval(row.difference),
                    formatRelative(row.relative), row.p ? fmt::format("{:.2g}", *row.p) : kNone,
                    row.a12 ? fmt::format("{:.2f}", *row.a12) : kNone, row.basis,
                    toString(row.judgement.verdict), row.judgement.reason});
  std::string text =
      fmt::format("#### {}\n\n{}",
                  pair.labelA == pair.labelB ? pair.labelA
                                             : fmt::format("A {}, B {}", pair.labelA, pair.labelB),
                  formatMarkdownTable({"Value", "A", "B", "B - A [95 %]", "relative [95 %]", "p",
                                       "A12", "of", "verdict", "why"},
                                      rows, "lrrrrrrlll"));
  if (!pair.notes.empty()) text += "\n";
  for (const std::string& note : pair.notes) text += "- " + escapeMarkdown(note) + "\n";
  return text;
}

std::string describe(const CompareSide& side) {
  const Environment& e = side.run.environment;
  return fmt::format("{}: {}, session {} with {} frames, {} repetitions; {} ({}, {}), {}",
                     side.argument, side.run.scene.name, side.run.session.name,
                     side.run.session.frames, side.run.repetitions, e.program,
                     e.gitRevision.value_or("no revision"), e.buildType, e.timeUtc);
}

}  // namespace

std::string renderCompareMarkdown(const Comparison& comparison, const CompareSide& a,
                                  const CompareSide& b, const CompareOptions& options) {
  std::string out =
      fmt::format("### B against A: {} BETTER, {} WORSE, {} SAME, {} UNCLEAR\n\n- A {}\n- B {}\n\n",
                  comparison.count(Verdict::kBetter), comparison.count(Verdict::kWorse),
                  comparison.count(Verdict::kSame), comparison.count(Verdict::kUnclear),
                  escapeMarkdown(describe(a)), escapeMarkdown(describe(b)));
  for (const ComparePair& pair : comparison.pairs) out += formatPair(pair) + "\n";
  for (const std::string& note : comparison.notes) out += "- " + escapeMarkdown(note) + "\n";
  out += fmt::format(
      "- BETTER and WORSE over repetitions: p < {:g} (Mann-Whitney), A12 at least {:g} or at most "
      "{:g} (Vargha-Delaney), a change of at least {:g} %; SAME: its whole interval within that "
      "(docs/compare.md)\n",
      options.verdict.alpha, options.verdict.effect, 1.0 - options.verdict.effect,
      100.0 * options.verdict.minChange);
  return out;
}

}  // namespace hlodbench
