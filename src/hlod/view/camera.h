#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace hlodbench {

// What stays the same over a session.
struct Lens {
  int width = 640;          // viewport, pixels
  int height = 480;         // viewport, pixels
  double fovyRad = 0.8727;  // vertical field of view, radians
  double nearPlane = 0.02;  // world units
  double farPlane = 100.0;  // world units
};

// Where the camera is in one frame.
struct Pose {
  glm::dvec3 position{0.0};                    // world units
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  // camera to world, unit; looks along its -z, +y up
};

// One frame's view. Kept in double precision: the strategies' decisions can be checked from the
// trace to the last printed digit; the renderer takes floats.
struct Camera {
  Lens lens;
  Pose pose;
  glm::dmat4 viewProjection{1.0};  // OpenGL clip space

  [[nodiscard]] glm::dvec3 forward() const { return pose.orientation * glm::dvec3(0.0, 0.0, -1.0); }
};

// Builds the matrices by GLM.
Camera makeCamera(const Lens& lens, const Pose& pose);

}  // namespace hlodbench
