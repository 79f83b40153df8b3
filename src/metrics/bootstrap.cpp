#include "metrics/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "metrics/summary.h"

namespace hlodbench {
namespace {

// A uniform index below `count`: values above the largest multiple of count are drawn again, so
// that no index is favoured.
std::size_t drawIndex(std::mt19937_64& engine, std::uint64_t count) {
  constexpr std::uint64_t kMax = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t usable = kMax - kMax % count;
  std::uint64_t value = engine();
  while (value >= usable) value = engine();
  return static_cast<std::size_t>(value % count);
}

void checkArguments(std::span<const double> sample, const BootstrapOptions& options) {
  if (sample.empty()) throw std::invalid_argument("computeMedianInterval: the sample is empty");
  for (const double value : sample)
    if (!std::isfinite(value))
      throw std::invalid_argument("computeMedianInterval: a value is not finite");
  if (options.resamples < 1 || !(options.confidence > 0.0 && options.confidence < 1.0))
    throw std::invalid_argument("computeMedianInterval: options are out of range");
}

}  // namespace

MedianInterval computeMedianInterval(std::span<const double> sample,
                                     const BootstrapOptions& options) {
  checkArguments(sample, options);
  std::vector<double> sorted(sample.begin(), sample.end());
  std::sort(sorted.begin(), sorted.end());
  MedianInterval interval;
  interval.median = computeQuantile(sorted, 0.5);
  if (sorted.size() < 2) return interval;

  std::mt19937_64 engine(options.seed);
  std::vector<double> medians(static_cast<std::size_t>(options.resamples));
  std::vector<double> resample(sorted.size());
  for (double& median : medians) {
    for (double& value : resample) value = sorted[drawIndex(engine, sorted.size())];
    std::sort(resample.begin(), resample.end());
    median = computeQuantile(resample, 0.5);
  }
  std::sort(medians.begin(), medians.end());
  const double tail = (1.0 - options.confidence) / 2.0;
  interval.low = computeQuantile(medians, tail);
  interval.high = computeQuantile(medians, 1.0 - tail);
  return interval;
}

}  // namespace hlodbench
