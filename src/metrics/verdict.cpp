#include "metrics/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hlodbench {
namespace {

std::string formatShare(double share) {
  return fmt::format("{:.3g} %", 100.0 * share);
}

bool areAllEqual(std::span<const double> a, std::span<const double> b) {
  const auto isFirst = [&](double value) { return value == a[0]; };
  return std::all_of(a.begin(), a.end(), isFirst) && std::all_of(b.begin(), b.end(), isFirst);
}

bool isWithin(const Interval& relative, double minChange) {
  return relative.low && relative.high && *relative.low >= -minChange &&
         *relative.high <= minChange;
}

Judgement judge(const NoisyComparison& c, std::size_t countA, std::size_t countB, Better better,
                const VerdictOptions& options) {
  if (!(computeSmallestP(countA, countB) < options.alpha)) {
    const std::size_t needed = computeNeededRepetitions(options.alpha);
    return {Verdict::kUnclear,
            fmt::format("too few repetitions: {} against {} give p = {:.2g} at least; {} each are "
                        "needed for p < {:g}",
                        countA, countB, computeSmallestP(countA, countB), needed, options.alpha)};
  }
  if (!c.change.relative) return {Verdict::kUnclear, "no relative change from 0"};
  const Interval& relative = *c.change.relative;
  const std::string p = fmt::format("p = {:.2g}", c.test.p);
  const bool isLarge = std::max(c.test.a12, 1.0 - c.test.a12) >= options.effect;
  const bool isChange = std::abs(relative.value) >= options.minChange;
  if (c.test.p < options.alpha && isLarge && isChange) {
    // where the samples and the pairs disagree on the direction, nothing is clear
    if ((relative.value > 0.0) != (c.test.a12 > 0.5))
      return {Verdict::kUnclear, p + ", but pairs and samples go different ways"};
    const Verdict direction = computeDirection(relative.value, better);
    if (direction != Verdict::kUnclear)
      return {direction, fmt::format("{}, A12 = {:.2f}", p, c.test.a12)};
    return {Verdict::kUnclear, p + ", but neither direction is better"};
  }
  if (isWithin(relative, options.minChange))
    return {Verdict::kSame, fmt::format("interval within +-{}", formatShare(options.minChange))};
  if (!(c.test.p < options.alpha))
    return {Verdict::kUnclear, fmt::format("{}, and the interval is too wide for SAME", p)};
  if (!isLarge)
    return {Verdict::kUnclear, fmt::format("{}, but A12 = {:.2f} is no effect of {:g}", p,
                                           c.test.a12, options.effect)};
  return {Verdict::kUnclear, fmt::format("{}, a change below {}, and the interval reaches beyond",
                                         p, formatShare(options.minChange))};
}

}  // namespace

const char* toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kSame:
      return "SAME";
    case Verdict::kBetter:
      return "BETTER";
    case Verdict::kWorse:
      return "WORSE";
    case Verdict::kUnclear:
      return "UNCLEAR";
  }
  return "";
}

Verdict computeDirection(double difference, Better better) {
  if (better == Better::kNeither || difference == 0.0) return Verdict::kUnclear;
  return (difference < 0.0) == (better == Better::kLower) ? Verdict::kBetter : Verdict::kWorse;
}

NoisyComparison compareNoisy(std::span<const double> a, std::span<const double> b, Better better,
                             bool paired, const VerdictOptions& options) {
  NoisyComparison comparison;
  comparison.test = computeMannWhitney(a, b);
  comparison.change = paired ? computePairedMedianChange(a, b) : computeMedianChange(a, b);
  if (areAllEqual(a, b) && computeSmallestP(a.size(), b.size()) < options.alpha)
    comparison.judgement = {Verdict::kSame, "equal in all repetitions"};
  else
    comparison.judgement = judge(comparison, a.size(), b.size(), better, options);
  return comparison;
}

}  // namespace hlodbench
