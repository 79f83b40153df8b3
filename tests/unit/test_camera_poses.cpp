#include "view/camera_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <vector>

#include "camera_inputs.h"

namespace hlodbench {

// Poses from elsewhere

TEST(CameraControl, TakesAnyPoseAsItIs) {
  RandomInput random(8);
  for (const glm::dvec3& up : kUps)
    for (const CameraMode mode : kModes)
      for (int i = 0; i < 100; ++i) {
        CameraControl control = makeControl(mode, up);
        glm::dvec3 axis = random.vector(1.0);
        const Pose pose{random.vector(30.0),
                        glm::normalize(glm::dquat(random.between(-1, 1), axis.x, axis.y, axis.z))};
        control.setPose(pose);
        EXPECT_TRUE(isSame(control.pose(), pose));
        const glm::dvec3 toPivot = control.pivot() - pose.position;
        EXPECT_NEAR(glm::distance(glm::normalize(toPivot), forward(pose)), 0.0, 1e-6);
        control.setMode(CameraMode::kWalk);
        expectLevel(control.pose(), up);
        EXPECT_EQ(control.pose().position, pose.position);
        EXPECT_NEAR(glm::distance(forward(control.pose()), forward(pose)), 0.0, 1e-9);
      }
}

TEST(CameraControl, GoesOnFromAPoseThatLooksStraightDown) {
  for (const double pitch : {-1.0, 1.0})
    for (const CameraMode mode : kModes) {
      CameraControl control = makeControl(mode);
      const glm::dquat yaw = glm::angleAxis(0.7, glm::dvec3(0, 1, 0));
      const Pose pose{{1, 2, 3},
                      yaw * glm::angleAxis(pitch * glm::half_pi<double>(), glm::dvec3(1, 0, 0))};
      control.setPose(pose);
      CameraInput input;
      input.turn = {1e-3, 0};
      control.update(input, kLens);
      EXPECT_GT(std::abs(glm::dot(control.pose().orientation, pose.orientation)), 1.0 - 1e-9);
      EXPECT_NEAR(glm::distance(control.pose().position, pose.position), 0.0, 1e-3);
    }
}

TEST(CameraControl, OrbitKeepsItsPivotWhenItsOwnPoseIsSet) {
  CameraControl control = makeControl(CameraMode::kOrbit);
  CameraInput input;
  input.turn = {100, 30};
  input.wheel = 4;
  input.pan = {20, 40};
  control.update(input, kLens);
  const glm::dvec3 pivot = control.pivot();
  control.setPose(control.pose());
  EXPECT_EQ(control.pivot(), pivot);
}

TEST(CameraControl, FlyingToThePivotMovesItOnlyWhenThere) {
  CameraControl control = makeControl(CameraMode::kFly);
  const glm::dvec3 pivot = control.pivot();
  CameraInput input;
  input.move.z = 1.0;
  input.seconds = 0.1;
  control.update(input, kLens);
  EXPECT_NEAR(glm::distance(control.pivot(), pivot), 0.0, 1e-9);
  const auto along = [&control] {
    return glm::dot(control.pivot() - control.pose().position, forward(control.pose()));
  };
  for (int i = 0; i < 3000; ++i) {
    control.update(input, kLens);
    EXPECT_GT(along(), 0.1);
  }
  const glm::dvec3 ahead = control.pivot();
  EXPECT_LT(along(), 5.0);
  control.setMode(CameraMode::kOrbit);
  EXPECT_EQ(control.pivot(), ahead);
}

// Going somewhere

TEST(CameraControl, GoesToAPoint) {
  RandomInput random(9);
  for (const CameraMode mode : kModes)
    for (int i = 0; i < 100; ++i) {
      CameraControl control = makeControl(mode);
      const glm::dvec3 point = glm::dvec3(2, 2, 12) + random.vector(4.0);
      const Pose start = control.pose();
      control.goTo(point);
      EXPECT_TRUE(control.isGoing());
      CameraInput input;
      double seconds = 0.0, longest = 0.0;
      while (control.isGoing() && seconds < 2.0) {
        input.seconds = random.between(0.001, 0.05);
        seconds += input.seconds;
        const Pose before = control.pose();
        control.update(input, kLens);
        longest = std::max(longest, glm::distance(before.position, control.pose().position));
        expectLevel(control.pose(), {0, 1, 0});
      }
      EXPECT_GT(seconds, 0.65);
      EXPECT_LT(seconds, 0.8);
      const double way = glm::distance(start.position, control.pose().position);
      EXPECT_LT(longest, 0.05 / 0.7 * 1.6 * way) << "no leap";
      EXPECT_NEAR(glm::distance(control.pivot(), point), 0.0, 1e-6);
      const glm::dvec3 toPoint = point - control.pose().position;
      EXPECT_NEAR(glm::distance(glm::normalize(toPoint), forward(control.pose())), 0.0, 1e-9);
      if (mode == CameraMode::kWalk)
        EXPECT_NEAR(control.pose().position.y, start.position.y, 1e-9);
      else
        EXPECT_LT(glm::length(toPoint), 4.0);
      EXPECT_EQ(control.mode(), mode);
    }
}

TEST(CameraControl, TurnsTheShortWayToAPoint) {
  for (int i = 0; i < 24; ++i) {
    CameraControl control = makeControl(CameraMode::kFly);
    CameraInput input;
    input.turn = {i * 100.0, 0};  // 24 of them are a whole turn
    control.update(input, kLens);
    control.goTo({2, 2, 12});
    input = {};
    input.seconds = 0.01;
    double turned = 0.0;
    while (control.isGoing()) {
      const glm::dvec3 before = forward(control.pose());
      control.update(input, kLens);
      turned += std::acos(std::min(1.0, glm::dot(before, forward(control.pose()))));
    }
    EXPECT_LT(turned, 1.01 * glm::pi<double>());
  }
}

TEST(CameraControl, GoesTheSameWayInAnyFrames) {
  for (const CameraMode mode : kModes) {
    CameraControl one = makeControl(mode), many = makeControl(mode);
    for (CameraControl* control : {&one, &many}) control->goTo({1, 1, 12});
    CameraInput input;
    for (int i = 0; i < 9; ++i) {
      input.seconds = 0.1;
      one.update(input, kLens);
      input.seconds = 0.01;
      for (int j = 0; j < 10; ++j) many.update(input, kLens);
      expectNear(one.pose(), many.pose());
      EXPECT_EQ(one.isGoing(), many.isGoing());
    }
    EXPECT_FALSE(one.isGoing());
  }
}

TEST(CameraControl, AnyMovementEndsGoing) {
  std::vector<CameraInput> inputs(3);
  inputs[0].move.x = 0.1;
  inputs[1].turn.y = 1.0;
  inputs[2].pan.x = 1.0;
  for (CameraInput input : inputs) {
    CameraControl control = makeControl(CameraMode::kOrbit);
    control.goTo({1, 1, 12});
    CameraInput none;
    none.seconds = 0.1;
    for (int i = 0; i < 3; ++i) control.update(none, kLens);
    const Pose before = control.pose();
    input.seconds = 0.001;
    control.update(input, kLens);
    EXPECT_FALSE(control.isGoing());
    EXPECT_LT(glm::distance(control.pose().position, before.position), 0.2) << "goes on from there";
    const glm::dvec3 toPivot = control.pivot() - control.pose().position;
    EXPECT_NEAR(glm::distance(glm::normalize(toPivot), forward(control.pose())), 0.0, 1e-9);
  }
  const std::vector<std::function<void(CameraControl&)>> others{
      [](CameraControl& c) { c.reset(); }, [](CameraControl& c) { c.setPose(Pose()); },
      [](CameraControl& c) { c.setMode(CameraMode::kFly); }};
  for (const auto& other : others) {
    CameraControl control = makeControl(CameraMode::kOrbit);
    control.goTo({1, 1, 12});
    other(control);
    EXPECT_FALSE(control.isGoing());
  }
}

TEST(CameraControl, GoesToPointsOverheadAndWhereItIs) {
  for (const CameraMode mode : kModes)
    for (const glm::dvec3& way :
         {glm::dvec3(0, 0, 0), glm::dvec3(0, 5, 0), glm::dvec3(0, -5, 0), glm::dvec3(0, 1e-9, 0)}) {
      CameraControl control = makeControl(mode);
      control.goTo(control.pose().position + way);
      CameraInput input;
      input.seconds = 0.1;
      for (int i = 0; i < 10; ++i) control.update(input, kLens);
      EXPECT_FALSE(control.isGoing());
      EXPECT_TRUE(std::isfinite(glm::length(control.pose().position)));
      EXPECT_GT(glm::dot(control.pivot() - control.pose().position, forward(control.pose())), 0.0);
      expectLevel(control.pose(), {0, 1, 0});
    }
}

}  // namespace hlodbench
