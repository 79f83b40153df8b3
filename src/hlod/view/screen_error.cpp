#include "hlod/view/screen_error.h"

#include <algorithm>
#include <cmath>

namespace hlodbench {

double computeDistance(const Camera& camera, const Aabb& box) {
  const glm::dvec3& eye = camera.pose.position;
  const glm::dvec3 outside = glm::max(glm::dvec3(box.min) - eye, eye - glm::dvec3(box.max));
  return glm::length(glm::max(outside, glm::dvec3(0.0)));
}

double computePixelScale(const Lens& lens) {
  return lens.height / (2.0 * std::tan(0.5 * lens.fovyRad));
}

double computeScreenError(const Camera& camera, const Aabb& box, double error) {
  const double distance = std::max(camera.lens.nearPlane, computeDistance(camera, box));
  return error * computePixelScale(camera.lens) / distance;
}

}  // namespace hlodbench
