#pragma once

#include "hlod/core/aabb.h"
#include "hlod/view/camera.h"

namespace hlodbench {

// Distance from the eye to the nearest point of the box, world units; 0 when the eye is inside.
// It is the priority of the traversal, too: a child is never nearer than its parent.
double computeDistance(const Camera& camera, const Aabb& box);

// Pixels that one world unit covers at distance 1: H / (2 tan(fovy / 2)).
double computePixelScale(const Lens& lens);

// Screen-space error (SSE) in pixels: what a model-space error of `error` world units projects to
// at the nearest point of the node's box, error * H / (2 tan(fovy/2)) / max(near, distance).
// Grows towards the root, since errors grow and boxes nest: the front is well defined.
// Source: paper, section 3.1; the nearest-point form follows Cignoni et al. 2004 and Yoon et al.
// 2004, which the paper cites for it.
double computeScreenError(const Camera& camera, const Aabb& box, double error);

}  // namespace hlodbench
