#include "view/scene_fit.h"

#include <algorithm>
#include <cmath>

#include "view/camera_control.h"

namespace hlodbench {
namespace {

constexpr double kMargin = 1.05;
constexpr double kFarRoom = 2.0;  // how much farther than the start one can go and see all
// far/near: with 24 bits, depths at the far plane are then told apart at 1 in 2000 of the distance,
// where a pixel of 1000 in height covers about 1 in 1000.
constexpr double kDepthRatio = 8000.0;

}  // namespace

double computeRadius(const Aabb& box) {
  const double radius =
      box.empty() ? 0.0 : 0.5 * glm::length(glm::dvec3(box.max) - glm::dvec3(box.min));
  return radius > 0.0 ? radius : 1.0;
}

glm::dvec3 computeCentre(const Aabb& box) {
  return box.empty() ? glm::dvec3(0.0) : 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max));
}

double computeFitDistance(const Aabb& box, const Lens& lens, const glm::dquat& orientation) {
  const double tanY = std::tan(0.5 * lens.fovyRad);
  const double tanX = tanY * lens.width / lens.height;
  const double radius = computeRadius(box);
  const glm::dvec3 half =
      box.empty() ? glm::dvec3(radius) : 0.5 * (glm::dvec3(box.max) - glm::dvec3(box.min));
  double distance = 0.1 * radius;  // of what has no extent
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    // As the camera sees it: +z comes nearer.
    const glm::dvec3 seen = glm::conjugate(orientation) * (signs * half);
    distance =
        std::max({distance, seen.z + std::abs(seen.x) / tanX, seen.z + std::abs(seen.y) / tanY});
  }
  return kMargin * distance;
}

Lens chooseLens(const Aabb& scene, int width, int height, double fovyRad) {
  Lens lens{width, height, fovyRad, 0.0, 0.0};
  // The sphere around the box is visible from here, whatever the direction.
  const double tanY = std::tan(0.5 * fovyRad);
  const double half = std::atan(tanY * std::min(1.0, static_cast<double>(width) / height));
  const double radius = computeRadius(scene);
  lens.farPlane = kFarRoom * kMargin * radius * (1.0 / std::sin(half) + 1.0);
  lens.nearPlane = lens.farPlane / kDepthRatio;
  return lens;
}

}  // namespace hlodbench
