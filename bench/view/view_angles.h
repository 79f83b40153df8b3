#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace hlodbench {

// An orientation as a person turns his head. Radians; at 0 0 0 with up = +y the view is along -z.
struct ViewAngles {
  double yaw = 0.0;    // about up, counter-clockwise seen from above
  double pitch = 0.0;  // above the horizon, -pi/2 to pi/2
  double roll = 0.0;   // about the view axis; 0: the horizon is level
};

// Angles against some up direction.
class ViewAxes {
 public:
  explicit ViewAxes(const glm::dvec3& up);  // unit
  [[nodiscard]] const glm::dvec3& up() const { return up_; }
  [[nodiscard]] glm::dquat toOrientation(const ViewAngles& angles) const;  // unit
  // Straight up or down, where yaw and roll are one, it is all yaw.
  [[nodiscard]] ViewAngles toAngles(const glm::dquat& orientation) const;
  // The angles of a view along a direction of any length but 0, without roll.
  [[nodiscard]] ViewAngles lookAlong(const glm::dvec3& direction) const;

 private:
  glm::dvec3 up_;
  glm::dquat base_;  // turns +y to up
};

}  // namespace hlodbench
