#pragma once

#include <optional>
#include <span>
#include <string>

#include "metrics/change.h"
#include "metrics/counters.h"
#include "metrics/mann_whitney.h"

namespace hlodbench {

enum class Verdict { kSame, kBetter, kWorse, kUnclear };

// "SAME", "BETTER", "WORSE", "UNCLEAR".
const char* toString(Verdict verdict);

// What a difference of noisy values must have to be called one.
struct VerdictOptions {
  double alpha = 0.05;        // p must be below it; above 0, below 1
  double effect = kLargeA12;  // A12, or 1 - A12, must be at least it; 0.5 to 1
  double minChange = 0.01;    // the relative change must be at least it; a share, at least 0
};

// A verdict on b against a, and why, in a few words.
struct Judgement {
  Verdict verdict = Verdict::kUnclear;
  std::string reason;
};

// Which way a difference goes; kUnclear where neither direction is better, or for no difference.
Verdict computeDirection(double difference, Better better);

// One noisy value over repetitions.
struct NoisyComparison {
  Change change;     // of medians
  MannWhitney test;  // of the values
  Judgement judgement;
};

// Judges values of a and b, one a repetition: BETTER or WORSE with p, effect and change as the
// options ask, SAME where the whole interval of the change is less than minChange, else UNCLEAR.
// Both need so many repetitions that p can be below alpha at all. With `paired`, a[i] and b[i] are
// of the same repetition and the change is taken within it; the test takes no notice of that.
// Throws as computeMannWhitney() does.
NoisyComparison compareNoisy(std::span<const double> a, std::span<const double> b, Better better,
                             bool paired, const VerdictOptions& options = {});

}  // namespace hlodbench
