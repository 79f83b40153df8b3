#pragma once

#include "traversals/bias.h"

namespace hlodbench {

// Fig. 3 reads the cached bias of a node's children without asking when they were visited.
enum class StaleChildren {
  kSkip,    // a child not visited in the last frame neither vetoes nor enters the average
  kLiteral  // as printed: its old values count
};

// Fig. 2 leaves the cached bias of a node alone when its query passes no pixel.
enum class ZeroPixels {
  kZeroBias,  // the bias becomes B(0) = 0, so that hidden children pull the average down
  kLiteral    // as printed: the old bias stays
};

// Simp(B) is a reconstruction: which bias of this frame stands in for the one not known yet.
enum class SimpEstimate {
  kLastProcessed,  // variant A: that of the node whose result came in last
  kRunningMean     // variant B: the mean over all results of this frame
};

// Everything that steers the four strategies.
struct TraversalOptions {
  double tau = 1.0;  // pixels of error, > 0 (paper, section 3.1)
  BiasOptions bias;
  StaleChildren staleChildren = StaleChildren::kSkip;
  ZeroPixels zeroPixels = ZeroPixels::kZeroBias;
  SimpEstimate simpEstimate = SimpEstimate::kLastProcessed;
};

}  // namespace hlodbench
