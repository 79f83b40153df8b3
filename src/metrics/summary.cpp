#include "metrics/summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace hlodbench {
namespace {

std::vector<double> computeMeasuredValues(const std::vector<FrameRecord>& records,
                                          Counter counter) {
  std::vector<double> values;
  values.reserve(records.size());
  for (const FrameRecord& record : records)
    if (!record.warmUp && record.has(counter)) values.push_back(record.get(counter));
  return values;
}

std::optional<CounterSummary> computeCounterSummary(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::sort(values.begin(), values.end());
  CounterSummary summary;
  summary.count = values.size();
  summary.mean = computeMean(values);
  summary.median = computeQuantile(values, 0.5);
  summary.min = values.front();
  summary.max = values.back();
  summary.q1 = computeQuantile(values, 0.25);
  summary.q3 = computeQuantile(values, 0.75);
  summary.p99 = computeQuantile(values, 0.99);
  summary.stddev = computeStddev(values, summary.mean);
  return summary;
}

void computeFps(const std::vector<double>& frameMs, Summary& summary) {
  const auto isPositive = [](double ms) { return ms > 0.0; };
  if (frameMs.empty() || !std::all_of(frameMs.begin(), frameMs.end(), isPositive)) return;
  const double count = static_cast<double>(frameMs.size());
  double totalMs = 0.0;
  double totalFps = 0.0;
  for (const double ms : frameMs) {
    totalMs += ms;
    totalFps += 1000.0 / ms;
  }
  summary.fps = 1000.0 * count / totalMs;
  summary.fpsFrameMean = totalFps / count;
}

std::optional<double> computeDelayedShare(const std::vector<FrameRecord>& records) {
  double delayed = 0.0;
  double drawn = 0.0;
  for (const FrameRecord& record : records) {
    if (record.warmUp || !record.has(Counter::kD) || !record.has(Counter::kDn)) continue;
    delayed += record.get(Counter::kD);
    drawn += record.get(Counter::kDn);
  }
  if (!(drawn > 0.0)) return std::nullopt;
  return delayed / drawn;
}

}  // namespace

double computeMean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Around the mean in a second pass: the sum-of-squares formula cancels for steady counters.
double computeStddev(std::span<const double> values, double mean) {
  if (values.size() < 2) return 0.0;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double computeQuantile(std::span<const double> sorted, double share) {
  if (sorted.empty()) throw std::invalid_argument("computeQuantile: the sample is empty");
  const double position = std::clamp(share, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double weight = position - static_cast<double>(below);
  return sorted[below] + weight * (sorted[above] - sorted[below]);
}

Summary computeSummary(const std::vector<FrameRecord>& records) {
  Summary summary;
  for (const FrameRecord& record : records)
    ++(record.warmUp ? summary.warmUpFrames : summary.frames);
  for (std::size_t i = 0; i < kCounterCount; ++i)
    summary.counters[i] =
        computeCounterSummary(computeMeasuredValues(records, kCounterTable[i].counter));
  computeFps(computeMeasuredValues(records, Counter::kFrameMs), summary);
  summary.delayedShare = computeDelayedShare(records);
  return summary;
}

}  // namespace hlodbench
