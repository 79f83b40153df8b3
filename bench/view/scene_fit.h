#pragma once

#include "hlod/core/aabb.h"
#include "hlod/view/camera.h"

namespace hlodbench {

// Half a box's diagonal, world units; of a point or an empty box 1, so that there is a size.
double computeRadius(const Aabb& box);
glm::dvec3 computeCentre(const Aabb& box);  // of an empty box the origin

// How far from the box's centre an eye with this orientation is to be so that it sees the whole
// box, with a small margin.
double computeFitDistance(const Aabb& box, const Lens& lens, const glm::dquat& orientation);

}  // namespace hlodbench
