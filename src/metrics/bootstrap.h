#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace hlodbench {

struct BootstrapOptions {
  int resamples = 10000;            // at least 1
  double confidence = 0.95;         // between 0 and 1
  std::uint64_t seed = 0x484c4f44;  // "HLOD"; the same seed gives the same interval everywhere
};

// The median of a sample and its percentile bootstrap interval (Efron 1979).
// low and high are absent for a single value, which says nothing about its spread. For up to five
// values the 95 % interval is the whole range of the sample, and cannot be more honest than that.
struct MedianInterval {
  double median = 0.0;
  std::optional<double> low;
  std::optional<double> high;

  bool operator==(const MedianInterval&) const = default;
};

// Resamples by IndexDrawer (metrics/resample.h): the same interval everywhere.
// The order of the sample has no influence. Throws std::invalid_argument for an empty sample, a
// value that is not finite, or options out of range.
MedianInterval computeMedianInterval(std::span<const double> sample,
                                     const BootstrapOptions& options = {});

}  // namespace hlodbench
