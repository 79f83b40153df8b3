#pragma once

#include <cstddef>
#include <span>

namespace hlodbench {

// How two independent samples a and b lie to each other.
struct MannWhitney {
  double u = 0.0;    // pairs (a, b) with b > a, and half of those that are equal; 0 to |a| |b|
  double p = 1.0;    // two-sided: that such a u, or a rarer one, comes about without a difference
  double a12 = 0.5;  // u / (|a| |b|): how likely a value of b is above one of a, ties counted half
  bool isExact = true;
};

// The U test (H. B. Mann, D. R. Whitney: On a Test of Whether one of Two Random Variables is
// Stochastically Larger than the Other. Annals of Mathematical Statistics 18(1), 1947) and the
// effect size A12 (A. Vargha, H. D. Delaney: A Critique and Improvement of the "CL" Common Language
// Effect Size Statistics of McGraw and Wong. Journal of Educational and Behavioral Statistics
// 25(2), 2000); Cliff's delta is 2 A12 - 1.
// Up to kMostExact values together, p counts all ways to deal the values to the two samples, with
// ties too (the shift algorithm: B. Streitberg, J. Roehmel, Statistical Software Newsletter 12(1),
// 1986): the normal approximation would call three against three ties significant. Above that it is
// the normal approximation with corrections for ties and continuity.
// Throws std::invalid_argument for an empty sample or a value that is not finite.
MannWhitney computeMannWhitney(std::span<const double> a, std::span<const double> b);
inline constexpr std::size_t kMostExact = 60;

// The smallest p that samples of n and m values can have: 2 / (n + m over n). n, m >= 1.
double computeSmallestP(std::size_t n, std::size_t m);

// How many values each of two samples needs, so that some outcome has a p below alpha (0 to 1).
std::size_t computeNeededRepetitions(double alpha);

// The convention for a large effect (Vargha and Delaney 2000): A12 from 0.71 up, or 0.29 down.
inline constexpr double kLargeA12 = 0.71;

}  // namespace hlodbench
