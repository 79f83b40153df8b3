#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "pose_checks.h"
#include "view/camera_control.h"

// A scene to look at, and what a user may do.
namespace hlodbench {

inline constexpr int kWidth = 800, kHeight = 600;
inline constexpr double kFovy = 0.9;
inline const std::vector<CameraMode> kModes{CameraMode::kOrbit, CameraMode::kFly,
                                            CameraMode::kWalk};
inline const std::vector<glm::dvec3> kUps{
    {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}, glm::normalize(glm::dvec3(1, -2, 3))};

inline Aabb makeBox(const glm::vec3& min, const glm::vec3& max) {
  Aabb box;
  box.min = min;
  box.max = max;
  return box;
}

inline const Aabb kScene = makeBox({-3, 0, 5}, {7, 4, 20});
inline const Lens kLens = chooseLens(kScene, kWidth, kHeight, kFovy);

class RandomInput {
 public:
  explicit RandomInput(unsigned seed) : engine_(seed) {}
  double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(engine_);
  }
  glm::dvec3 vector(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  bool chance() { return between(0.0, 1.0) < 0.5; }
  CameraInput input() {
    CameraInput input;
    if (chance()) input.move = vector(1.0);
    if (chance()) input.turn = {between(-50, 50), between(-50, 50)};
    if (chance()) input.pan = {between(-50, 50), between(-50, 50)};
    if (chance()) input.wheel = between(-2, 2);
    input.fast = chance();
    input.seconds = between(0.0, 0.1);
    return input;
  }

 private:
  std::mt19937 engine_;
};

inline CameraControl makeControl(CameraMode mode, const glm::dvec3& up = {0, 1, 0}) {
  CameraControl control(kScene, kLens, up);
  control.setMode(mode);
  return control;
}

inline glm::dvec3 forward(const Pose& pose) {
  return pose.orientation * glm::dvec3(0, 0, -1);
}

// No roll: the picture's x is level, and its y points up rather than down.
inline void expectLevel(const Pose& pose, const glm::dvec3& up) {
  EXPECT_NEAR(glm::dot(pose.orientation * glm::dvec3(1, 0, 0), up), 0.0, 1e-12);
  EXPECT_GT(glm::dot(pose.orientation * glm::dvec3(0, 1, 0), up), 0.0);
  EXPECT_NEAR(glm::length(pose.orientation), 1.0, 1e-15);
}

// Pixels from the picture's middle, right and down, and the depth along the view.
inline glm::dvec3 project(const Pose& pose, const Lens& lens, const glm::dvec3& point) {
  const glm::dvec3 seen = glm::conjugate(pose.orientation) * (point - pose.position);
  const double pixels = 0.5 * lens.height / std::tan(0.5 * lens.fovyRad);
  return {pixels * seen.x / -seen.z, -pixels * seen.y / -seen.z, -seen.z};
}

}  // namespace hlodbench
