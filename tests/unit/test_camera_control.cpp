#include "view/camera_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "camera_inputs.h"

namespace hlodbench {
namespace {

void expectAllVisible(const Aabb& box, const Pose& pose, const Lens& lens) {
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 point(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                           corner & 4 ? box.max.z : box.min.z);
    const glm::dvec3 seen = project(pose, lens, point);
    EXPECT_LT(std::abs(seen.x), 0.5 * lens.width);
    EXPECT_LT(std::abs(seen.y), 0.5 * lens.height);
    EXPECT_GT(seen.z, lens.nearPlane);
    EXPECT_LT(seen.z, lens.farPlane);
  }
}

}  // namespace

TEST(CameraControl, StartsWithTheWholeSceneSeenFromAbove) {
  const std::vector<Aabb> scenes{kScene, makeBox({0, 0, 0}, {1000, 1, 1}),
                                 makeBox({-1e-3f, 0, 0}, {1e-3f, 1e-3f, 1e-3f}),
                                 makeBox({5, 5, 5}, {6, 5, 6}), makeBox({2, 2, 2}, {2, 2, 2})};
  for (const Aabb& scene : scenes)
    for (const auto& [width, height] : {std::pair(800, 600), std::pair(300, 900)})
      for (const double fovy : {0.2, 0.9, 2.0})
        for (const glm::dvec3& up : kUps) {
          const Lens lens = chooseLens(scene, width, height, fovy);
          CameraControl control(scene, lens, up);
          EXPECT_EQ(control.mode(), CameraMode::kOrbit);
          expectAllVisible(scene, control.pose(), lens);
          expectLevel(control.pose(), up);
          EXPECT_LT(glm::dot(forward(control.pose()), up), -0.1);
          EXPECT_GT(glm::dot(forward(control.pose()), up), -0.6);
          EXPECT_LE(lens.farPlane / lens.nearPlane, 10000.0) << "for 24 bits of depth";
        }
}

TEST(CameraControl, TheEmptySceneHasAStartToo) {
  const Lens lens = chooseLens(Aabb(), kWidth, kHeight, kFovy);
  EXPECT_GT(lens.nearPlane, 0.0);
  EXPECT_GT(lens.farPlane, lens.nearPlane);
  const CameraControl control(Aabb(), lens);
  EXPECT_TRUE(std::isfinite(glm::length(control.pose().position)));
  EXPECT_GT(control.speed(), 0.0);
}

TEST(CameraControl, WithoutInputThePoseStaysBitByBit) {
  RandomInput random(1);
  for (const CameraMode mode : kModes)
    for (int i = 0; i < 50; ++i) {
      CameraControl control = makeControl(mode, kUps[static_cast<std::size_t>(i) % kUps.size()]);
      for (int j = 0; j < i; ++j) control.update(random.input(), kLens);
      const Pose before = control.pose();
      for (const double seconds : {0.0, 0.01, 5.0, -1.0}) {
        CameraInput none;
        none.seconds = seconds;
        control.update(none, kLens);
        EXPECT_TRUE(isSame(control.pose(), before));
      }
      // nor do the modes change a level pose
      for (const CameraMode other : kModes) {
        control.setMode(other);
        EXPECT_TRUE(isSame(control.pose(), before));
      }
      control.setPose(before);
      EXPECT_TRUE(isSame(control.pose(), before));
      control.goTo({0, 1, 0});
      control.update({}, kLens);
      EXPECT_TRUE(isSame(control.pose(), before)) << "no time has passed";
    }
}

TEST(CameraControl, NeverRolls) {
  RandomInput random(2);
  for (const CameraMode mode : kModes)
    for (const glm::dvec3& up : kUps) {
      CameraControl control = makeControl(mode, up);
      for (int i = 0; i < 2000; ++i) {
        control.update(random.input(), kLens);
        if (i % 50 == 0) control.goTo(random.vector(20.0));
        if (i % 70 == 0) control.setMode(kModes[static_cast<std::size_t>(i / 70) % 3]);
        expectLevel(control.pose(), up);
      }
    }
}

TEST(CameraControl, HowTimeIsCutIntoFramesDoesNotMatter) {
  RandomInput random(3);
  for (const CameraMode mode : kModes)
    for (int i = 0; i < 100; ++i) {
      CameraInput input;
      input.move = random.vector(1.0);
      if (i % 4 == 0) input.move.z = 0.0;
      input.fast = random.chance();
      CameraControl one = makeControl(mode);
      CameraControl many = makeControl(mode);
      input.seconds = 0.1;
      one.update(input, kLens);
      const int frames = 2 + i;
      input.seconds = 0.1 / frames;
      for (int j = 0; j < frames; ++j) many.update(input, kLens);
      EXPECT_GT(glm::distance(one.pose().position, makeControl(mode).pose().position), 1e-4);
      expectNear(one.pose(), many.pose());
      EXPECT_NEAR(one.speed(), many.speed(), 1e-9);
      EXPECT_NEAR(glm::distance(one.pivot(), many.pivot()), 0.0, 1e-9);
    }
}

TEST(CameraControl, AStallIsNoLeap) {
  for (const CameraMode mode : kModes) {
    CameraControl stalled = makeControl(mode), smooth = makeControl(mode);
    CameraInput input;
    input.move.z = 1.0;
    input.seconds = 30.0;
    stalled.update(input, kLens);
    input.seconds = 0.1;
    smooth.update(input, kLens);
    expectNear(stalled.pose(), smooth.pose());
  }
}

TEST(CameraControl, FastIsFourTimesTheSpeed) {
  for (const CameraMode mode : {CameraMode::kFly, CameraMode::kWalk}) {
    CameraControl slow = makeControl(mode), fast = makeControl(mode);
    const Pose start = slow.pose();
    CameraInput input;
    input.move = {1, 0, 1};
    input.seconds = 0.1;
    slow.update(input, kLens);
    EXPECT_NEAR(glm::distance(slow.pose().position, start.position), 0.1 * slow.speed(), 1e-9);
    input.fast = true;
    fast.update(input, kLens);
    EXPECT_NEAR(glm::distance(fast.pose().position, start.position), 0.4 * slow.speed(), 1e-9);
  }
}

TEST(CameraControl, ResetIsTheStart) {
  RandomInput random(10);
  for (const CameraMode mode : kModes) {
    CameraControl control = makeControl(mode);
    const Pose start = control.pose();
    for (int i = 0; i < 30; ++i) control.update(random.input(), kLens);
    control.reset();
    EXPECT_TRUE(isSame(control.pose(), start));
    EXPECT_EQ(control.mode(), mode);
  }
}

}  // namespace hlodbench
