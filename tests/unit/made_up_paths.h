#pragma once

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "hlod/view/camera.h"
#include "pose_checks.h"

// Paths to test with.
namespace hlodbench {

inline constexpr double kStep = 1.0 / 60.0;  // seconds
inline const Pose kBegin{{1.0, 2.0, 3.0}, glm::angleAxis(0.3, glm::dvec3(0.0, 1.0, 0.0))};

class RandomPoses {
 public:
  explicit RandomPoses(unsigned seed) : engine_(seed) {}
  double normal() { return normal_(engine_); }
  double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(engine_);
  }
  Pose pose() {
    return {{normal(), normal(), normal()},
            glm::normalize(glm::dquat(normal(), normal(), normal(), normal()))};
  }
  std::vector<Pose> poses(int count) {
    std::vector<Pose> made;
    for (int i = 0; i < count; ++i) made.push_back(pose());
    return made;
  }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
};

// Straight on and turning about one axis, each at constant speed: 1.5 radians a second.
inline Pose moveEvenly(double seconds) {
  const glm::dquat turn = glm::angleAxis(1.5 * seconds, glm::normalize(glm::dvec3(1, 2, 3)));
  return {kBegin.position + seconds * glm::dvec3(4.0, -1.0, 0.5), turn * kBegin.orientation};
}

inline std::vector<Pose> moveEvenly(int count, double step) {
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) poses.push_back(moveEvenly(i * step));
  return poses;
}

inline void expectSame(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_TRUE(isSame(a[i], b[i])) << i;
}

}  // namespace hlodbench
