#pragma once

#include <optional>
#include <span>

#include "metrics/bootstrap.h"

namespace hlodbench {

// An estimate and its percentile bootstrap interval (B. Efron: Bootstrap Methods: Another Look at
// the Jackknife. Annals of Statistics 7(1), 1979); no interval for a single value.
struct Interval {
  double value = 0.0;
  std::optional<double> low, high;

  bool operator==(const Interval&) const = default;
};

// How b differs from a. These throw std::invalid_argument for an empty sample, pairs of unlike
// number, a value that is not finite, or options out of range; the same input gives the same output
// everywhere.
struct Change {
  Interval absolute;                 // b - a, in the unit of the values
  std::optional<Interval> relative;  // b / a - 1; absent where some value of a is not above 0
};

// Of means over pairs (a[i], b[i]), such as the same frame of two replays: pairs are resampled.
// Relative: mean of b over mean of a less 1, where every mean of a is above 0.
Change computeMeanChange(std::span<const double> a, std::span<const double> b,
                         const BootstrapOptions& options = {});

// Of medians of two independent samples: each is resampled by itself.
Change computeMedianChange(std::span<const double> a, std::span<const double> b,
                           const BootstrapOptions& options = {});

// The median over pairs (a[i], b[i]) of b - a and of b / a - 1, such as two strategies in the same
// repetition: what slows both down is in neither.
Change computePairedMedianChange(std::span<const double> a, std::span<const double> b,
                                 const BootstrapOptions& options = {});

}  // namespace hlodbench
