#include "metrics/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hlodbench {
namespace {

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
  const std::string p = fmt::format("p = {:.2g}", c.test.p);
  const std::string effect = fmt::format("A12 = {:.2f}", c.test.a12);
  const bool isSignificant = c.test.p < options.alpha;
  const bool isLarge = std::max(c.test.a12, 1.0 - c.test.a12) >= options.effect;
  // from 0, any change is as large as can be
  const double size = c.change.relative ? c.change.relative->value : c.change.absolute.value;
  const bool isChange = c.change.relative ? std::abs(size) >= options.minChange : size != 0.0;
  if (isSignificant && isLarge && isChange) {
    if ((size > 0.0) != (c.test.a12 > 0.5))
      return {Verdict::kUnclear, p + ", but pairs and samples go different ways"};
    const Verdict direction = computeDirection(size, better);
    return {direction,
            p + ", " + effect +
                (direction == Verdict::kUnclear ? ", but neither direction is better" : "")};
  }
  const std::string most = fmt::format("+-{:.3g} %", 100.0 * options.minChange);
  if (c.change.relative && isWithin(*c.change.relative, options.minChange))
    return {Verdict::kSame, "interval within " + most};
  if (!isSignificant) return {Verdict::kUnclear, p + ", and the interval reaches beyond " + most};
  if (!isLarge)
    return {Verdict::kUnclear,
            fmt::format("{}, but {} is no effect of {:g}", p, effect, options.effect)};
  return {Verdict::kUnclear,
          fmt::format("{}, a change within {}, but the interval reaches beyond", p, most)};
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
