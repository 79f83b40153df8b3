#include <gtest/gtest.h>

#include <random>

#include "hlod/build/surface_distance.h"

namespace hlodbench {
namespace {

// Nearest point by nested ternary search in barycentric coordinates: slow, and shares no code.
double slowDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                    const glm::dvec3& c) {
  const auto onLine = [&](double u) {
    const glm::dvec3 start = a + (b - a) * u;
    const glm::dvec3 along = (c - a) * (1.0 - u);
    const double length = glm::dot(along, along);
    const double t = length > 0 ? glm::clamp(glm::dot(p - start, along) / length, 0.0, 1.0) : 0.0;
    return glm::length(p - start - along * t);
  };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double x = low + (high - low) / 3, y = high - (high - low) / 3;
    (onLine(x) < onLine(y) ? high : low) = onLine(x) < onLine(y) ? y : x;
  }
  return onLine(low);
}

class Points {
 public:
  explicit Points(unsigned seed) : random_(seed) {}
  glm::vec3 next() { return {unit_(random_), unit_(random_), unit_(random_)}; }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<float> unit_{-1.0f, 1.0f};
};

TEST(PointTriangleDistance, AgreesWithASearch) {
  Points points(5);
  for (int i = 0; i < 3000; ++i) {
    const glm::vec3 a = points.next();
    glm::vec3 b = points.next();
    glm::vec3 c = points.next();
    if (i % 5 == 1) c = a + (b - a) * 0.3f;         // no area
    if (i % 5 == 2) b = c = a;                      // a point
    if (i % 5 == 3) c = b + points.next() * 1e-3f;  // a sliver
    const glm::vec3 p = points.next() * 2.0f;
    EXPECT_NEAR(std::sqrt(pointTriangleDistanceSquared(p, a, b, c)), slowDistance(p, a, b, c), 2e-5)
        << i;
  }
}

TEST(SurfaceDistance, FindsTheNearestOfAllTriangles) {
  Points points(9);
  std::vector<glm::vec3> corners;
  for (int i = 0; i < 500; ++i) {
    const glm::vec3 centre = points.next();
    for (int k = 0; k < 3; ++k) corners.push_back(centre + points.next() * 0.1f);
  }
  const SurfaceDistance surface(corners);
  std::uint32_t hint = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 p = points.next() * 1.5f;
    float nearest = 1e30f;
    for (std::size_t t = 0; t < corners.size(); t += 3)
      nearest = std::min(
          nearest, pointTriangleDistanceSquared(p, corners[t], corners[t + 1], corners[t + 2]));
    const float rounding = 1e-5f * nearest + 1e-9f;
    EXPECT_NEAR(surface.distanceSquared(p, -1.0f, hint), nearest, rounding);
    const float enough = 0.04f;
    const float bound = surface.distanceSquared(p, enough, hint);
    EXPECT_GE(bound, nearest - rounding);
    if (bound > enough) {
      EXPECT_NEAR(bound, nearest, rounding);
    }
  }
}

}  // namespace
}  // namespace hlodbench
