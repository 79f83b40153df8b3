#include "metrics/change.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "metrics/resample.h"
#include "metrics/summary.h"

namespace hlodbench {
namespace {

void checkArguments(std::span<const double> a, std::span<const double> b, bool paired,
                    const BootstrapOptions& options) {
  if (a.empty() || b.empty()) throw std::invalid_argument("change: a sample is empty");
  if (paired && a.size() != b.size()) throw std::invalid_argument("change: pairs are incomplete");
  for (const auto& sample : {a, b})
    for (const double value : sample)
      if (!std::isfinite(value)) throw std::invalid_argument("change: a value is not finite");
  if (options.resamples < 1 || !(options.confidence > 0.0 && options.confidence < 1.0))
    throw std::invalid_argument("change: options are out of range");
}

bool isPositive(double value) {
  return value > 0.0;
}

double computeMedian(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return computeQuantile(values, 0.5);
}

// The estimates from the resamples; makes intervals of them.
class Resamples {
 public:
  explicit Resamples(const BootstrapOptions& options) : options_(options) {}

  void add(double a, double b) {
    absolute_.push_back(b - a);
    if (isPositive(a)) relative_.push_back(b / a - 1.0);
  }

  Change finish(double a, double b, bool hasInterval) {
    Change change;
    change.absolute.value = b - a;
    const bool hasRelative = isPositive(a) && relative_.size() == absolute_.size();
    if (hasRelative) change.relative = Interval{b / a - 1.0, {}, {}};
    if (!hasInterval) return change;
    setBounds(absolute_, change.absolute);
    if (hasRelative) setBounds(relative_, *change.relative);
    return change;
  }

 private:
  void setBounds(std::vector<double>& estimates, Interval& interval) const {
    std::sort(estimates.begin(), estimates.end());
    const double tail = (1.0 - options_.confidence) / 2.0;
    interval.low = computeQuantile(estimates, tail);
    interval.high = computeQuantile(estimates, 1.0 - tail);
  }

  const BootstrapOptions& options_;
  std::vector<double> absolute_, relative_;
};

Interval toInterval(const MedianInterval& interval) {
  return {interval.median, interval.low, interval.high};
}

}  // namespace

Change computeMeanChange(std::span<const double> a, std::span<const double> b,
                         const BootstrapOptions& options) {
  checkArguments(a, b, true, options);
  IndexDrawer indices(options.seed, a.size());
  const double count = static_cast<double>(a.size());
  Resamples resamples(options);
  for (int i = 0; i < options.resamples; ++i) {
    double sumA = 0.0;
    double sumB = 0.0;
    for (std::size_t j = 0; j < a.size(); ++j) {
      const std::size_t pair = indices.draw();
      sumA += a[pair];
      sumB += b[pair];
    }
    resamples.add(sumA / count, sumB / count);
  }
  return resamples.finish(computeMean(a), computeMean(b), a.size() > 1);
}

Change computeMedianChange(std::span<const double> a, std::span<const double> b,
                           const BootstrapOptions& options) {
  checkArguments(a, b, false, options);
  // sorted, so that the order of the samples has no influence
  std::vector<double> sortedA(a.begin(), a.end());
  std::vector<double> sortedB(b.begin(), b.end());
  const double medianA = computeMedian(sortedA);
  const double medianB = computeMedian(sortedB);
  IndexDrawer indicesA(options.seed, a.size());
  IndexDrawer indicesB(options.seed + 1, b.size());
  std::vector<double> drawnA(a.size());
  std::vector<double> drawnB(b.size());
  Resamples resamples(options);
  for (int i = 0; i < options.resamples; ++i) {
    for (double& value : drawnA) value = sortedA[indicesA.draw()];
    for (double& value : drawnB) value = sortedB[indicesB.draw()];
    const double median = computeMedian(drawnA);
    resamples.add(median, computeMedian(drawnB));
  }
  return resamples.finish(medianA, medianB, a.size() > 1 && b.size() > 1);
}

Change computePairedMedianChange(std::span<const double> a, std::span<const double> b,
                                 const BootstrapOptions& options) {
  checkArguments(a, b, true, options);
  std::vector<double> differences, ratios;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences.push_back(b[i] - a[i]);
    if (isPositive(a[i])) ratios.push_back(b[i] / a[i] - 1.0);
  }
  Change change{toInterval(computeMedianInterval(differences, options)), {}};
  if (ratios.size() == a.size())
    change.relative = toInterval(computeMedianInterval(ratios, options));
  return change;
}

}  // namespace hlodbench
