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

// Fig. 3: what a child at which refinement did not stop, or would not stop again, says of its
// parent.
enum class PullUp {
  kRefine,  // candidateToShiftUp <- false: the parent is refined
  kDelay    // "return Delay", as one transcription of the figure has it
};

// Whether a node drawn on a Stop is drawn again when its result confirms the Stop.
enum class RenderGuard {
  kOn,  // once a frame
  kOff  // as Fig. 2 is printed: its Render knows no guard
};

// A box with a corner at or before the near plane.
enum class NearPlane {
  kVisible,  // gets no query: seen whole
  kQuery     // is queried while the eye is outside of it, as Fig. 2 queries every box
};

// Which pixels of a box are the denominator of mu (paper, section 3.2).
enum class MuArea {
  kClipped,   // those in the viewport
  kUnclipped  // all that the projected box would cover, in the viewport or not
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
  PullUp pullUp = PullUp::kRefine;
  RenderGuard renderGuard = RenderGuard::kOn;
  NearPlane nearPlane = NearPlane::kVisible;
  MuArea muArea = MuArea::kClipped;
};

}  // namespace hlodbench
