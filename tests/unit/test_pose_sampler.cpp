#include "view/pose_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "made_up_paths.h"

namespace hlodbench {
namespace {

// What a sampler makes of an even movement that is displayed at random times.
std::vector<Pose> sample(RandomPoses& random, double seconds, double longest) {
  PoseSampler sampler(kStep);
  std::vector<Pose> given;
  for (double time = 0.0;;) {
    const std::vector<Pose> due = sampler.add(100.0 + time, moveEvenly(time));
    given.insert(given.end(), due.begin(), due.end());
    if (time == seconds) return given;
    time = std::min(seconds, time + random.between(0.0, longest));
  }
}

}  // namespace

TEST(PoseSampler, DoesNotDependOnHowDisplayedFramesFall) {
  RandomPoses random(9);
  for (const double longest : {0.001, 0.02, 0.05, 0.3}) {
    const std::vector<Pose> given = sample(random, 2.0 + 0.5 * kStep, longest);
    ASSERT_EQ(given.size(), 121u) << longest;
    for (std::size_t i = 0; i < given.size(); ++i)
      expectNear(given[i], moveEvenly(static_cast<double>(i) * kStep), 1e-10);
  }
}

TEST(PoseSampler, TakesFramesThatFallOnTheStepsAsTheyAre) {
  PoseSampler sampler(kStep);
  double time = 1000.0;  // whose sum drifts in the last digits
  for (int i = 0; i < 1000; ++i, time += kStep) {
    const Pose pose = moveEvenly(i * kStep);
    const std::vector<Pose> due = sampler.add(time, pose);
    ASSERT_EQ(due.size(), 1u) << i;
    expectNear(due[0], pose, 1e-8);
  }
}

TEST(PoseSampler, GivesTheFirstPoseOfAStretchAtOnce) {
  PoseSampler sampler(kStep);
  RandomPoses random(10);
  for (double time : {5.0, 9.0, 11.0}) {
    sampler.restart();
    const Pose pose = random.pose();
    expectSame(sampler.add(time, pose), {pose});
    EXPECT_TRUE(sampler.add(time, random.pose()).empty()) << "no time has passed";
    EXPECT_EQ(sampler.add(time + 2.5 * kStep, random.pose()).size(), 2u);
  }
}

TEST(PoseSampler, AStretchThatGoesOnFromTheLastPoseDoesNotRepeatIt) {
  PoseSampler sampler(kStep);
  sampler.add(0.0, kBegin);
  const Pose last = sampler.add(kStep, moveEvenly(kStep)).back();
  sampler.restart();
  EXPECT_TRUE(sampler.add(7.0, last).empty());
  const Pose next = moveEvenly(2.0 * kStep);
  const std::vector<Pose> due = sampler.add(7.0 + kStep, next);
  ASSERT_EQ(due.size(), 1u);
  expectNear(due[0], next, 1e-9);

  // What was displayed last and not given out is no repetition.
  const Pose displayed = moveEvenly(2.5 * kStep);
  EXPECT_TRUE(sampler.add(7.0 + 1.5 * kStep, displayed).empty());
  sampler.restart();
  expectSame(sampler.add(8.0, displayed), {displayed});

  // From elsewhere it does begin with its first pose: also the second time.
  sampler.restart();
  expectSame(sampler.add(9.0, kBegin), {kBegin});
  sampler.restart();
  EXPECT_TRUE(sampler.add(10.0, kBegin).empty());
}

TEST(PoseSampler, GoesOnFromWhatACutLeft) {
  PoseSampler sampler(kStep);
  sampler.add(0.0, kBegin);
  const Pose last = sampler.add(kStep, moveEvenly(kStep)).back();
  sampler.restartAfter(kBegin);
  EXPECT_TRUE(sampler.add(7.0, kBegin).empty());
  sampler.restartAfter(kBegin);
  expectSame(sampler.add(8.0, last), {last});
}

TEST(PoseSampler, StandingStillGivesEqualPoses) {
  PoseSampler sampler(kStep);
  sampler.add(0.0, kBegin);
  expectSame(sampler.add(3.5 * kStep, kBegin), {kBegin, kBegin, kBegin});
}

}  // namespace hlodbench
