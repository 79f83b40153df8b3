#include "metrics/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "metrics/resample.h"
#include "metrics/summary.h"

namespace hlodbench {
namespace {

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

  IndexDrawer indices(options.seed, sorted.size());
  std::vector<double> medians(static_cast<std::size_t>(options.resamples));
  std::vector<double> resample(sorted.size());
  for (double& median : medians) {
    for (double& value : resample) value = sorted[indices.draw()];
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
