#pragma once

#include <string>

#include "hlod/tree/hierarchy.h"
#include "session.h"

namespace hlodbench {

struct DepthComplexity {
  double mean = 0.0, min = 0.0, max = 0.0;  // layers per covered pixel, over the frames taken
  double coverage = 0.0;                    // covered share of the viewport, 0 to 1
  int frames = 0;                           // frames taken that show anything
};

// Draws all leaves of the hierarchy, both faces, without a depth test, and counts the pixels drawn
// against the pixels covered, in every `every`-th frame of the session. Throws GlUnavailable.
DepthComplexity measureDepthComplexity(const Hierarchy& hierarchy, const Session& session,
                                       int every, const std::string& context);

}  // namespace hlodbench
