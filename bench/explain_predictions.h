#pragma once

#include <vector>

#include "hlod/tree/hierarchy.h"
#include "traversals/front_recording.h"

namespace hlodbench {

// What a strategy said of a node inside the frustum before it knew.
struct PredictedNode {
  NodeId node = kNoNode;
  Prediction prediction = Prediction::kDelay;
};

// One frame's predictions, each in one of the four.
struct PredictionCounts {
  int right = 0;  // Refine, Stop or Delay where SW(B) refined, drew or culled the node;
                  // Stop or Delay below its front, Delay below what it culled
  int tooConservative =
      0;                  // Refine at its front or below; Refine or Stop at or below what it culled
  int tooAggressive = 0;  // Stop where it refined
  int needlessDelays = 0;  // Delay where it drew or refined

  bool operator==(const PredictionCounts&) const = default;
};

// Judges predictions by what SW(B) did in the same frame. Throws std::invalid_argument for a node
// none of whose ancestors SW(B) decided, which no strategy can reach in that frame.
PredictionCounts judgePredictions(const Hierarchy& hierarchy,
                                  const std::vector<PredictedNode>& predictions,
                                  const RecordedFrame& truth);

}  // namespace hlodbench
