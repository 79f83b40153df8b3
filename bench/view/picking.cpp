#include "view/picking.h"

#include <cmath>

namespace hlodbench {

glm::dvec3 computePointAt(const Camera& camera, double x, double y, double depth) {
  const Lens& lens = camera.lens;
  const double pixel = 2.0 * std::tan(0.5 * lens.fovyRad) / lens.height;  // at distance 1
  const glm::dvec3 direction((x - 0.5 * lens.width) * pixel, (0.5 * lens.height - y) * pixel, -1.0);
  return camera.pose.position + camera.pose.orientation * (depth * direction);
}

}  // namespace hlodbench
