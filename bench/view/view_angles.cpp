#include "view/view_angles.h"

#include <cmath>

namespace hlodbench {
namespace {

const glm::dvec3 kRight{1.0, 0.0, 0.0}, kUp{0.0, 1.0, 0.0}, kBack{0.0, 0.0, 1.0};

// Of a unit direction: below it, the horizontal part is rounding.
constexpr double kPole = 1e-9;

// From +y to `up` about the axis between them.
glm::dquat turnUpTo(const glm::dvec3& up) {
  if (up.y < -1.0 + 1e-12) return {0.0, 1.0, 0.0, 0.0};  // half a turn about x
  const glm::dvec3 axis = glm::cross(kUp, up);
  return glm::normalize(glm::dquat(1.0 + up.y, axis.x, axis.y, axis.z));
}

glm::dquat combine(double yaw, double pitch) {
  return glm::angleAxis(yaw, kUp) * glm::angleAxis(pitch, kRight);
}

}  // namespace

ViewAxes::ViewAxes(const glm::dvec3& up) : up_(up), base_(turnUpTo(up)) {}

glm::dquat ViewAxes::toOrientation(const ViewAngles& angles) const {
  glm::dquat local = combine(angles.yaw, angles.pitch);
  if (angles.roll != 0.0) local = local * glm::angleAxis(angles.roll, kBack);
  return glm::normalize(base_ * local);
}

ViewAngles ViewAxes::toAngles(const glm::dquat& orientation) const {
  const glm::dquat local = glm::conjugate(base_) * orientation;
  const glm::dvec3 forward = local * -kBack;
  ViewAngles angles;
  angles.pitch = std::atan2(forward.y, std::hypot(forward.x, forward.z));
  if (std::hypot(forward.x, forward.z) < kPole) {
    // There the picture's up is horizontal, and ahead of who looks down, behind who looks up.
    const glm::dvec3 ahead = (forward.y < 0.0 ? 1.0 : -1.0) * (local * kUp);
    angles.yaw = std::atan2(-ahead.x, -ahead.z);
  } else {
    angles.yaw = std::atan2(-forward.x, -forward.z);
  }
  // What is left once yaw and pitch are taken away turns about the view axis.
  const glm::dquat rest = glm::conjugate(combine(angles.yaw, angles.pitch)) * local;
  angles.roll = 2.0 * std::atan2(rest.w < 0.0 ? -rest.z : rest.z, std::abs(rest.w));
  return angles;
}

ViewAngles ViewAxes::lookAlong(const glm::dvec3& direction) const {
  const glm::dvec3 local = glm::conjugate(base_) * direction;
  const double level = std::hypot(local.x, local.z);
  return {level > 0.0 ? std::atan2(-local.x, -local.z) : 0.0, std::atan2(local.y, level), 0.0};
}

}  // namespace hlodbench
