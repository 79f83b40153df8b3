#pragma once

#include <vector>

#include "hlod/build/simplifier.h"

namespace hlodbench {

// Goes on where half-edge meshes are stuck: collapses edges of a triangle list, cheapest first,
// without asking whether the result is manifold, so that handles close and small bodies fold up.
// Locked vertices stay, collapses that turn faces over come last. triangles: over the input's
// vertices, three different corners each; returns at most input.targetTriangles of them, or more
// where only locked vertices are left. The input's own triangles and origins are not looked at.
// Counts the faces that were turned over.
std::vector<glm::uvec3> collapseFreely(const SimplifierInput& input,
                                       std::vector<glm::uvec3> triangles, SimplifierStats& stats);

}  // namespace hlodbench
