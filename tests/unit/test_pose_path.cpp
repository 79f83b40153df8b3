#include "view/pose_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "made_up_paths.h"

namespace hlodbench {
namespace {

double measureRoughness(const std::vector<Pose>& poses) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < poses.size(); ++i)
    sum += glm::length(poses[i - 1].position - 2.0 * poses[i].position + poses[i + 1].position);
  return sum;
}

}  // namespace

// Interpolation

TEST(PosePath, InterpolatesEvenlyAndTheShortWay) {
  RandomPoses random(1);
  for (int round = 0; round < 200; ++round) {
    const Pose a = random.pose(), b = random.pose();
    const double share = random.between(0.0, 1.0);
    const Pose between = interpolatePose(a, b, share);
    const auto angle = [](const Pose& p, const Pose& q) {
      return 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(p.orientation, q.orientation))));
    };
    EXPECT_NEAR(angle(a, between), share * angle(a, b), 1e-7);
    EXPECT_NEAR(angle(between, b), (1.0 - share) * angle(a, b), 1e-7);
    EXPECT_NEAR(glm::length(between.orientation), 1.0, 1e-14);
    EXPECT_NEAR(glm::distance(a.position, between.position),
                share * glm::distance(a.position, b.position), 1e-12);
    Pose turned = b;
    turned.orientation = -turned.orientation;
    expectNear(interpolatePose(a, turned, share), between, 1e-12);
    EXPECT_TRUE(isSame(interpolatePose(a, b, 0.0), a));
    EXPECT_TRUE(isSame(interpolatePose(a, b, 1.0), b));
  }
}

// Another time step

TEST(PosePath, AtTheSameStepIsTheSame) {
  const std::vector<Pose> poses = RandomPoses(2).poses(57);
  expectSame(resamplePoses(poses, kStep, kStep), poses);
  expectSame(resamplePoses({}, kStep, 2.0 * kStep), {});
  expectSame(resamplePoses(std::span(poses).first(1), kStep, 0.1), {poses[0]});
}

TEST(PosePath, AtAMultipleOfTheStepIsEveryNthPose) {
  const std::vector<Pose> poses = RandomPoses(3).poses(61);
  for (const std::size_t n : {2u, 3u, 4u, 5u, 7u}) {
    std::vector<Pose> expected;
    for (std::size_t i = 0; i < poses.size(); i += n) expected.push_back(poses[i]);
    expectSame(resamplePoses(poses, kStep, static_cast<double>(n) * kStep), expected);
  }
}

TEST(PosePath, AtAPartOfTheStepKeepsAllPoses) {
  const std::vector<Pose> poses = RandomPoses(4).poses(40);
  for (const std::size_t n : {2u, 3u, 5u, 7u, 10u}) {
    const std::vector<Pose> fine = resamplePoses(poses, 0.1, 0.1 / static_cast<double>(n));
    ASSERT_EQ(fine.size(), (poses.size() - 1) * n + 1);
    for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_TRUE(isSame(fine[i * n], poses[i]));
    // and back
    expectSame(resamplePoses(fine, 0.1 / static_cast<double>(n), 0.1), poses);
  }
}

TEST(PosePath, AtAnyStepIsTheSamePath) {
  RandomPoses random(5);
  for (int round = 0; round < 100; ++round) {
    const int count = 2 + round;
    const double from = random.between(0.001, 0.1), to = random.between(0.001, 0.1);
    const std::vector<Pose> poses = resamplePoses(moveEvenly(count, from), from, to);
    ASSERT_EQ(poses.size(), static_cast<std::size_t>((count - 1) * from / to) + 1);
    for (std::size_t i = 0; i < poses.size(); ++i)
      expectNear(poses[i], moveEvenly(static_cast<double>(i) * to), 1e-10);
  }
}

// Steps such as 1/60 are no exact doubles: seconds are a whole number of them all the same.
TEST(PosePath, KeepsTheLastPoseOfWholeSeconds) {
  const std::vector<int> rates{24, 25, 30, 50, 60, 72, 90, 144};
  for (const int seconds : {1, 7, 600})
    for (const int from : rates) {
      const std::vector<Pose> poses = moveEvenly(seconds * from + 1, 1.0 / from);
      for (const int to : rates) {
        const std::vector<Pose> other = resamplePoses(poses, 1.0 / from, 1.0 / to);
        ASSERT_EQ(other.size(), static_cast<std::size_t>(seconds * to + 1)) << from << " " << to;
        EXPECT_TRUE(isSame(other.back(), poses.back()));
      }
    }
}

// Smoothing

TEST(PosePath, SmoothedByNothingIsTheSame) {
  const std::vector<Pose> poses = RandomPoses(6).poses(20);
  expectSame(smoothPoses(poses, kStep, 0.0), poses);
  expectSame(smoothPoses({}, kStep, 0.5), {});
}

TEST(PosePath, SmoothingKeepsAnEvenPath) {
  const std::vector<Pose> poses = moveEvenly(200, kStep);
  for (const double sigma : {0.01, 0.1, 0.3, 10.0}) {
    const std::vector<Pose> smooth = smoothPoses(poses, kStep, sigma);
    ASSERT_EQ(smooth.size(), poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) expectNear(smooth[i], poses[i], 1e-12);
  }
}

TEST(PosePath, SmoothingKeepsTheEndsAndUnitQuaternions) {
  for (const int count : {1, 2, 3, 50}) {
    const std::vector<Pose> poses = RandomPoses(7).poses(count);
    const std::vector<Pose> smooth = smoothPoses(poses, kStep, 0.2);
    ASSERT_EQ(smooth.size(), poses.size());
    EXPECT_TRUE(isSame(smooth.front(), poses.front()));
    EXPECT_TRUE(isSame(smooth.back(), poses.back()));
    for (const Pose& pose : smooth) EXPECT_NEAR(glm::length(pose.orientation), 1.0, 1e-14);
  }
}

TEST(PosePath, SmoothingTakesAwayNoise) {
  RandomPoses random(8);
  const std::vector<Pose> even = moveEvenly(300, kStep);
  std::vector<Pose> noisy = even;
  for (Pose& pose : noisy)
    pose.position += 0.02 * glm::dvec3(random.normal(), random.normal(), random.normal());
  double before = measureRoughness(noisy);
  for (const double sigma : {0.02, 0.05, 0.1, 0.2}) {
    const std::vector<Pose> smooth = smoothPoses(noisy, kStep, sigma);
    const double after = measureRoughness(smooth);
    EXPECT_LT(after, 0.7 * before) << sigma;
    before = after;
    for (std::size_t i = 60; i + 60 < even.size(); ++i)
      EXPECT_LT(glm::distance(smooth[i].position, even[i].position), 0.08);
  }
}

TEST(PosePath, SmoothingDoesNotMindTheSignOfQuaternions) {
  const std::vector<Pose> poses = moveEvenly(100, kStep);
  std::vector<Pose> flipped = poses;
  for (std::size_t i = 0; i < flipped.size(); i += 3)
    flipped[i].orientation = -flipped[i].orientation;
  const std::vector<Pose> a = smoothPoses(poses, kStep, 0.1);
  const std::vector<Pose> b = smoothPoses(flipped, kStep, 0.1);
  for (std::size_t i = 0; i < a.size(); ++i) expectNear(a[i], b[i], 1e-12);
}

}  // namespace hlodbench
