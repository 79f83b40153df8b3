#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hlod/tree/octahedral.h"

namespace hlodbench {
namespace {

double degreesBetween(const glm::vec3& a, const glm::vec3& b) {
  const glm::dvec3 u(a), v(b);
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)) * 180.0 / std::acos(-1.0);
}

TEST(Octahedral, EveryCodeOfAUnitVectorDecodesToUnitLength) {
  for (int x = -127; x <= 127; ++x)
    for (int y = -127; y <= 127; ++y)
      EXPECT_NEAR(
          glm::length(decodeOctahedral({static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)})),
          1.0f, 1e-6f);
}

TEST(Octahedral, DirectionsComeBackWithinOnePointOneDegrees) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  double worst = 0.0;
  double sum = 0.0;
  constexpr int kDirections = 200'000;
  for (int i = 0; i < kDirections; ++i) {
    const glm::vec3 n = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    const double angle = degreesBetween(n, decodeOctahedral(encodeOctahedral(n)));
    worst = std::max(worst, angle);
    sum += angle;
  }
  EXPECT_LT(worst, 1.1);
  EXPECT_LT(sum / kDirections, 0.4);
}

TEST(Octahedral, TheCodeIsTheBestOfThoseAroundIt) {
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 20'000; ++i) {
    const glm::vec3 n = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    const OctahedralNormal code = encodeOctahedral(n);
    const double angle = degreesBetween(n, decodeOctahedral(code));
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        if (std::abs(code[0] + dx) > 127 || std::abs(code[1] + dy) > 127) continue;
        const OctahedralNormal other{static_cast<std::int8_t>(code[0] + dx),
                                     static_cast<std::int8_t>(code[1] + dy)};
        EXPECT_LE(angle, degreesBetween(n, decodeOctahedral(other)) + 0.08);
      }
  }
}

TEST(Octahedral, AxesAreExactAndNothingHasADirection) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.0f, 1.0f}) {
      glm::vec3 n(0.0f);
      n[axis] = sign;
      EXPECT_EQ(decodeOctahedral(encodeOctahedral(n)), n);
      EXPECT_EQ(decodeOctahedral(encodeOctahedral(n * 17.0f)), n);
    }
  EXPECT_EQ(decodeOctahedral(encodeOctahedral(glm::vec3(0.0f))), glm::vec3(0, 1, 0));
  EXPECT_EQ(decodeOctahedral(encodeOctahedral(glm::vec3(NAN))), glm::vec3(0, 1, 0));
}

}  // namespace
}  // namespace hlodbench
