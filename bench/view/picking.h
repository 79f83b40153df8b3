#pragma once

#include <glm/glm.hpp>

#include "hlod/view/camera.h"

namespace hlodbench {

// The point that a pixel shows. x, y: pixels of the camera's viewport from the upper left; depth:
// distance along the view axis, world units.
glm::dvec3 computePointAt(const Camera& camera, double x, double y, double depth);

}  // namespace hlodbench
