#include "view/camera_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "camera_inputs.h"

namespace hlodbench {

// Orbit

TEST(CameraControl, OrbitTurnsAboutItsPivot) {
  RandomInput random(4);
  for (const glm::dvec3& up : kUps) {
    CameraControl control = makeControl(CameraMode::kOrbit, up);
    const glm::dvec3 pivot = control.pivot();
    const double distance = glm::distance(control.pose().position, pivot);
    for (int i = 0; i < 500; ++i) {
      CameraInput input;
      input.turn = {random.between(-300, 300), random.between(-300, 300)};
      control.update(input, kLens);
      EXPECT_EQ(control.pivot(), pivot);
      EXPECT_NEAR(glm::distance(control.pose().position, pivot), distance, 1e-9);
      EXPECT_NEAR(
          glm::distance(control.pose().position + distance * forward(control.pose()), pivot), 0.0,
          1e-9);
      EXPECT_LT(std::abs(glm::dot(forward(control.pose()), up)), 1.0 - 1e-5) << "at a pole";
    }
  }
}

TEST(CameraControl, WhatIsBeforeThePivotFollowsThePointer) {
  CameraControl control = makeControl(CameraMode::kOrbit);
  const glm::dvec3 near = glm::mix(control.pose().position, control.pivot(), 0.9);
  for (const glm::dvec2 turn : {glm::dvec2(20, 0), glm::dvec2(0, 20)}) {
    CameraControl turned = control;
    CameraInput input;
    input.turn = turn;
    turned.update(input, kLens);
    const glm::dvec2 moved(project(turned.pose(), kLens, near));
    EXPECT_GT(glm::dot(moved, turn), 1.0);
  }
}

TEST(CameraControl, PanningKeepsThePivotsPlaneUnderThePointer) {
  RandomInput random(5);
  for (int i = 0; i < 200; ++i) {
    CameraControl control = makeControl(CameraMode::kOrbit);
    CameraInput input;
    input.turn = {random.between(-500, 500), random.between(-200, 200)};
    input.wheel = random.between(-3, 10);
    control.update(input, kLens);
    const Pose before = control.pose();
    const glm::dvec3 point =
        control.pivot() +
        before.orientation * glm::dvec3(random.between(-2, 2), random.between(-2, 2), 0.0);
    const double distance = glm::distance(before.position, control.pivot());
    input = {};
    input.pan = {random.between(-200, 200), random.between(-200, 200)};
    control.update(input, kLens);
    const glm::dvec2 moved(project(control.pose(), kLens, point) - project(before, kLens, point));
    EXPECT_NEAR(glm::distance(moved, input.pan), 0.0, 1e-6);
    EXPECT_EQ(control.pose().orientation, before.orientation);
    EXPECT_NEAR(glm::distance(control.pose().position, control.pivot()), distance, 1e-9);
  }
}

TEST(CameraControl, TheWheelComesNearerByAFactor) {
  CameraControl control = makeControl(CameraMode::kOrbit);
  const glm::dvec3 pivot = control.pivot();
  const auto away = [&] { return glm::distance(control.pose().position, pivot); };
  const Pose start = control.pose();
  CameraInput in, out;
  in.wheel = 1.0;
  out.wheel = -1.0;
  double before = away();
  control.update(in, kLens);
  const double factor = away() / before;
  EXPECT_LT(factor, 1.0);
  before = away();
  control.update(in, kLens);
  EXPECT_NEAR(away() / before, factor, 1e-9);
  for (int i = 0; i < 2; ++i) control.update(out, kLens);
  expectNear(control.pose(), start);
  // between the planes, so that what is looked at can be seen
  for (int i = 0; i < 300; ++i) control.update(in, kLens);
  EXPECT_GT(away(), kLens.nearPlane);
  for (int i = 0; i < 300; ++i) control.update(out, kLens);
  EXPECT_LT(away(), kLens.farPlane);
  EXPECT_EQ(control.pivot(), pivot);
}

TEST(CameraControl, OrbitKeysPanAndComeNearer) {
  CameraControl control = makeControl(CameraMode::kOrbit);
  const Pose start = control.pose();
  const double distance = glm::distance(start.position, control.pivot());
  CameraInput input;
  input.move = {1, 0, 0};
  input.seconds = 0.1;
  control.update(input, kLens);
  const glm::dvec3 way = control.pose().position - start.position;
  EXPECT_NEAR(glm::dot(way, start.orientation * glm::dvec3(1, 0, 0)), 0.1 * control.speed(), 1e-9);
  EXPECT_NEAR(glm::distance(control.pose().position, control.pivot()), distance, 1e-9);
  const glm::dvec3 pivot = control.pivot();
  input.move = {0, 0, 1};
  control.update(input, kLens);
  EXPECT_EQ(control.pivot(), pivot);
  EXPECT_LT(glm::distance(control.pose().position, pivot), 0.95 * distance);
}

// Fly and walk

TEST(CameraControl, FlyLooksRoundFromWhereItIs) {
  CameraControl control = makeControl(CameraMode::kFly);
  const Pose start = control.pose();
  CameraInput input;
  input.turn = {10, 0};
  control.update(input, kLens);
  EXPECT_EQ(control.pose().position, start.position);
  EXPECT_GT(glm::dot(forward(control.pose()), start.orientation * glm::dvec3(1, 0, 0)), 1e-3)
      << "right is right";
  input.turn = {0, 10};
  control.update(input, kLens);
  EXPECT_LT(forward(control.pose()).y, forward(start).y) << "down is down";
  EXPECT_EQ(control.pose().position, start.position);
}

TEST(CameraControl, FlyMovesAlongTheAxesOfTheView) {
  RandomInput random(6);
  CameraControl control = makeControl(CameraMode::kFly);
  for (int i = 0; i < 100; ++i) {
    CameraInput input;
    input.turn = {random.between(-200, 200), random.between(-200, 200)};
    control.update(input, kLens);
    const Pose before = control.pose();
    input = {};
    input.move = 0.5 * random.vector(1.0);
    input.seconds = 0.05;
    control.update(input, kLens);
    const glm::dvec3 seen =
        glm::conjugate(before.orientation) * (control.pose().position - before.position);
    const glm::dvec3 expected =
        0.05 * control.speed() * glm::dvec3(input.move.x, input.move.y, -input.move.z);
    EXPECT_NEAR(glm::distance(seen, expected), 0.0, 1e-9);
    EXPECT_EQ(control.pose().orientation, before.orientation);
  }
}

TEST(CameraControl, TheWheelChangesTheSpeedOfFlyingAndWalking) {
  for (const CameraMode mode : {CameraMode::kFly, CameraMode::kWalk}) {
    CameraControl control = makeControl(mode);
    const Pose start = control.pose();
    const double speed = control.speed();
    CameraInput input;
    input.wheel = 1.0;
    control.update(input, kLens);
    const double factor = control.speed() / speed;
    EXPECT_GT(factor, 1.0);
    control.update(input, kLens);
    EXPECT_NEAR(control.speed(), speed * factor * factor, 1e-9);
    for (int i = 0; i < 500; ++i) control.update(input, kLens);
    EXPECT_LT(control.speed(), 1000.0);
    input.wheel = -1.0;
    for (int i = 0; i < 1000; ++i) control.update(input, kLens);
    EXPECT_GT(control.speed(), 1e-5);
    EXPECT_TRUE(isSame(control.pose(), start));
    control.reset();
    EXPECT_EQ(control.speed(), speed);
  }
}

TEST(CameraControl, WalkKeepsItsHeight) {
  RandomInput random(7);
  for (const glm::dvec3& up : kUps) {
    CameraControl control = makeControl(CameraMode::kWalk, up);
    const double height = glm::dot(control.pose().position, up);
    for (int i = 0; i < 500; ++i) {
      CameraInput input = random.input();
      input.pan = {0, 0};
      input.move.y = 0.0;
      const glm::dvec3 before = control.pose().position;
      control.update(input, kLens);
      const glm::dvec3 way = control.pose().position - before;
      EXPECT_NEAR(glm::dot(control.pose().position, up), height, 1e-8);
      const double length = std::min(1.0, glm::length(input.move)) * (input.fast ? 4.0 : 1.0);
      EXPECT_NEAR(glm::length(way), length * control.speed() * input.seconds, 1e-9)
          << "as fast, however steeply one looks";
      if (input.move.z > 0.1 && input.seconds > 0.01) {
        const glm::dvec3 right = control.pose().orientation * glm::dvec3(1, 0, 0);
        const glm::dvec3 ahead = glm::cross(up, right);
        EXPECT_GT(glm::dot(way, ahead), 0.0);
      }
    }
    CameraInput input;
    input.move.y = 1.0;
    input.seconds = 0.1;
    const glm::dvec3 before = control.pose().position;
    control.update(input, kLens);
    EXPECT_NEAR(glm::distance(control.pose().position, before + 0.1 * control.speed() * up), 0.0,
                1e-9);
  }
}

}  // namespace hlodbench
