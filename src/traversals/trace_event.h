#pragma once

#include <hlodbench/predictor.h>

#include <cstdint>
#include <vector>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

using plugin::Prediction;

// One decision of a strategy, in order of happening; a trace file is made of these.
struct TraceEvent {
  enum class Type : std::uint8_t { kVisit, kNear, kQuery, kResult, kDraw, kRarn };
  Type type;
  NodeId node;
  // kVisit
  bool inFrustum = false;  // when false, sse and prediction mean nothing
  Prediction prediction = Prediction::kDelay;
  double sse = 0.0;  // pixels
  // kResult
  std::uint32_t pixels = 0;  // that passed
  double boxPixels = 0.0;    // projected area of the box, at least 1
  double mu = 0.0;           // relative visibility, 0 to 1
  double bias = 0.0;         // 0 to 1
  bool stop = false;         // what it decided
};

using Trace = std::vector<TraceEvent>;

}  // namespace hlodbench
