#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "metrics/counters.h"

namespace hlodbench {

// One counter over the frames that have it, in the counter's own unit.
struct CounterSummary {
  std::size_t count = 0;  // frames that have the counter; at least 1
  double mean = 0.0;
  double median = 0.0;
  double min = 0.0;
  double max = 0.0;
  double q1 = 0.0;  // quantiles interpolate linearly between order statistics (see computeQuantile)
  double q3 = 0.0;
  double p99 = 0.0;
  double stddev = 0.0;  // of the sample (divided by count - 1); 0 for a single frame

  bool operator==(const CounterSummary&) const = default;
};

// What a table needs of one replay of a session by one strategy. Warm-up frames count nowhere but
// in warmUpFrames. What cannot be computed is absent, not 0.
struct Summary {
  std::size_t frames = 0;        // measured frames
  std::size_t warmUpFrames = 0;  // excluded from everything else here
  std::array<std::optional<CounterSummary>, kCounterCount> counters;
  std::optional<double> fps;           // frames over total time, 1/s: the main definition
  std::optional<double> fpsFrameMean;  // mean of 1000 / frame_ms, 1/s: weighs fast frames more
  std::optional<double> delayedShare;  // sum of D over sum of DN, 0 to 1 (paper, section 5.2)

  [[nodiscard]] const std::optional<CounterSummary>& get(Counter c) const {
    return counters[static_cast<std::size_t>(c)];
  }
  bool operator==(const Summary&) const = default;
};

// The value below which `share` (0 to 1) of a sorted, non-empty sample lies, interpolated linearly
// between neighbours at position share * (n - 1): the default of NumPy and R (type 7).
double computeQuantile(std::span<const double> sorted, double share);

// Of a non-empty sample.
double computeMean(std::span<const double> values);
// Of the sample around its mean (divided by count - 1); 0 for a single value.
double computeStddev(std::span<const double> values, double mean);

// Summarises the frames that are not warm-up. Both FPS figures are absent when no measured frame
// has a frame time or one is not above 0; the delayed share is absent without D or with DN all 0.
Summary computeSummary(const std::vector<FrameRecord>& records);

}  // namespace hlodbench
