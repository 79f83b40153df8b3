// The analytic quantities behind the refinement condition, against brute force.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "hlod/view/frustum.h"
#include "hlod/view/projected_area.h"
#include "hlod/view/screen_error.h"
#include "traversals/bias.h"

namespace hlodbench {
namespace {

Camera makeRandomCamera(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Lens lens;
  lens.nearPlane = 0.1;
  Pose pose;
  pose.position = {3 * uniform(random), 3 * uniform(random), 3 * uniform(random)};
  pose.orientation = glm::normalize(
      glm::dquat(uniform(random), uniform(random), uniform(random), uniform(random)));
  return makeCamera(lens, pose);
}

Aabb makeRandomBox(std::mt19937& random) {
  std::uniform_real_distribution<float> place(-10.0f, 10.0f);
  std::uniform_real_distribution<float> size(0.0f, 3.0f);
  const glm::vec3 min(place(random), place(random), place(random));
  return {min, min + glm::vec3(size(random), size(random), size(random))};
}

std::vector<glm::dvec2> projectCorners(const Camera& camera, const Aabb& box) {
  std::vector<glm::dvec2> points;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec4 p = camera.viewProjection * glm::dvec4((i & 1) ? box.max.x : box.min.x,
                                                            (i & 2) ? box.max.y : box.min.y,
                                                            (i & 4) ? box.max.z : box.min.z, 1.0);
    points.emplace_back((p.x / p.w * 0.5 + 0.5) * camera.lens.width,
                        (p.y / p.w * 0.5 + 0.5) * camera.lens.height);
  }
  return points;
}

double cross(const glm::dvec2& o, const glm::dvec2& a, const glm::dvec2& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

// True when p is inside the convex hull of the points: it is in one of all their triangles.
bool isInHull(const std::vector<glm::dvec2>& points, const glm::dvec2& p) {
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const double a = cross(points[i], points[j], p);
        const double b = cross(points[j], points[k], p);
        const double c = cross(points[k], points[i], p);
        if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) return true;
      }
  return false;
}

TEST(ProjectedArea, EqualsTheCountOfPixelCentresInTheClippedHull) {
  std::mt19937 random(1);
  int tested = 0;
  while (tested < 150) {
    const Camera camera = makeRandomCamera(random);
    const Aabb box = makeRandomBox(random);
    if (isCutByNearPlane(camera, box) || !Frustum(camera).intersects(box)) continue;
    const std::vector<glm::dvec2> points = projectCorners(camera, box);
    const double area = computeProjectedArea(camera, box);
    constexpr int kStep = 4;  // one sample stands for 16 pixels
    int inside = 0;
    for (int y = kStep / 2; y < camera.lens.height; y += kStep)
      for (int x = kStep / 2; x < camera.lens.width; x += kStep)
        inside += isInHull(points, {x, y}) ? 1 : 0;
    // the outline is at most the viewport's: a band of half a step on either side of it
    EXPECT_NEAR(area, inside * kStep * kStep, 2.0 * (640 + 480) * 0.5 * kStep);
    if (area > 2000) {
      EXPECT_NEAR(inside * kStep * kStep / area, 1.0, 0.15);
    }
    ++tested;
  }
}

TEST(ProjectedArea, IsAtMostTheViewport) {
  Lens lens;
  const Camera camera = makeCamera(lens, Pose{});
  EXPECT_NEAR(computeProjectedArea(camera, {{-99, -99, -2}, {99, 99, -1}}), 640.0 * 480.0, 1e-6);
}

TEST(ProjectedArea, IsNothingForABoxBesideTheViewport) {
  const Camera camera = makeCamera(Lens{}, Pose{});
  EXPECT_DOUBLE_EQ(computeProjectedArea(camera, {{50, 0, -2}, {51, 1, -1}}), 0.0);
}

TEST(ProjectedArea, UnclippedIsTheSameForABoxInsideTheViewport) {
  const Camera camera = makeCamera(Lens{}, Pose{});
  const Aabb inside{{-1, -1, -12}, {1, 1, -10}};
  EXPECT_NEAR(computeUnclippedArea(camera, inside), computeProjectedArea(camera, inside), 1e-9);
  // a flat box, half of it beside the viewport: its width counts in full
  const double edge = 10.0 * std::tan(0.5 * camera.lens.fovyRad) * 640.0 / 480.0;
  const float x = static_cast<float>(edge);
  const Aabb half{{x - 1, -1, -10}, {x + 1, 1, -10}};
  EXPECT_NEAR(computeUnclippedArea(camera, half) / computeProjectedArea(camera, half), 2.0, 1e-4);
}

// Whether the ray from the eye through a pixel of the viewport hits the box.
bool isHit(const Camera& camera, const Aabb& box, double column, double row) {
  const glm::dvec4 far = glm::inverse(camera.viewProjection) *
                         glm::dvec4(2.0 * column / camera.lens.width - 1.0,
                                    2.0 * row / camera.lens.height - 1.0, 1.0, 1.0);
  const glm::dvec3 direction = glm::dvec3(far) / far.w - camera.pose.position;
  double enter = 0.0;
  double leave = 1e300;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min[axis] - camera.pose.position[axis]) / direction[axis];
    const double b = (box.max[axis] - camera.pose.position[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

TEST(ProjectedArea, OfACutBoxIsWhatItCoversInFrontOfTheEye) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  int cut = 0;
  int covered = 0;
  for (int i = 0; i < 3000 && cut < 60; ++i) {
    Camera camera = makeRandomCamera(random);
    const glm::vec3 at = glm::vec3(camera.pose.position) +
                         glm::vec3(uniform(random), uniform(random), uniform(random));
    const glm::vec3 half =
        0.01f + 0.8f * glm::abs(glm::vec3(uniform(random), uniform(random), uniform(random)));
    const Aabb box{at - half, at + half};
    if (!isCutByNearPlane(camera, box) || computeDistance(camera, box) <= 0.0) continue;
    ++cut;
    const int side = 200;
    int hits = 0;
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column)
        hits += isHit(camera, box, (column + 0.5) / side * camera.lens.width,
                      (row + 0.5) / side * camera.lens.height)
                    ? 1
                    : 0;
    const double viewport = static_cast<double>(camera.lens.width) * camera.lens.height;
    EXPECT_NEAR(computeProjectedAreaOfCutBox(camera, box) / viewport,
                static_cast<double>(hits) / (side * side), 0.01);
    covered += hits > 100 ? 1 : 0;
  }
  EXPECT_EQ(cut, 60);
  EXPECT_GT(covered, 10);
}

TEST(ProjectedArea, OfABoxThatIsNotCutIsTheSameByFaces) {
  std::mt19937 random(12);
  for (int i = 0; i < 2000; ++i) {
    const Camera camera = makeRandomCamera(random);
    const Aabb box = makeRandomBox(random);
    if (isCutByNearPlane(camera, box)) continue;
    const double area = computeProjectedArea(camera, box);
    EXPECT_NEAR(computeProjectedAreaOfCutBox(camera, box), area, 1e-6 * (1.0 + area));
  }
}

TEST(NearPlane, CutsABoxWithACornerBehindIt) {
  Lens lens;
  lens.nearPlane = 1.0;
  const Camera camera = makeCamera(lens, Pose{});
  EXPECT_TRUE(isCutByNearPlane(camera, {{-1, -1, -5}, {1, 1, -0.5f}}));
  EXPECT_TRUE(isCutByNearPlane(camera, {{-1, -1, -5}, {1, 1, 5}}));
  EXPECT_FALSE(isCutByNearPlane(camera, {{-1, -1, -5}, {1, 1, -1.5f}}));
}

TEST(Frustum, KeepsEveryBoxThatAPointInsideBelongsTo) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> clip(-0.999, 0.999);
  for (int i = 0; i < 2000; ++i) {
    const Camera camera = makeRandomCamera(random);
    const glm::dvec4 p = glm::inverse(camera.viewProjection) *
                         glm::dvec4(clip(random), clip(random), clip(random), 1.0);
    const glm::vec3 point = glm::vec3(p / p.w);
    const Aabb size = makeRandomBox(random);
    const glm::vec3 half = 0.5f * (size.max - size.min) + 1e-3f;
    EXPECT_TRUE(Frustum(camera).intersects({point - half, point + half}));
  }
}

TEST(Frustum, DropsABoxBehindTheCamera) {
  const Camera camera = makeCamera(Lens{}, Pose{});
  EXPECT_FALSE(Frustum(camera).intersects({{-1, -1, 1}, {1, 1, 2}}));
}

TEST(ScreenError, NeverDecreasesTowardsTheRoot) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const Camera camera = makeRandomCamera(random);
    const Aabb child = makeRandomBox(random);
    Aabb parent = child;
    parent.extend(makeRandomBox(random));
    EXPECT_GE(computeScreenError(camera, parent, 0.5), computeScreenError(camera, child, 0.5));
    EXPECT_LE(computeDistance(camera, parent), computeDistance(camera, child));
  }
}

TEST(ScreenError, IsThePixelsOfTheErrorAtTheNearestPoint) {
  Lens lens;
  lens.fovyRad = 2.0 * std::atan(0.5);  // 480 pixels a unit at distance 1
  const Camera camera = makeCamera(lens, Pose{});
  EXPECT_NEAR(computeScreenError(camera, {{-1, -1, -20}, {1, 1, -10}}, 0.5), 24.0, 1e-9);
  // inside the box, the near plane stands for the distance
  EXPECT_NEAR(computeScreenError(camera, {{-1, -1, -1}, {1, 1, 1}}, 0.001), 24.0, 1e-9);
}

TEST(Bias, KeepsTheLimitsThatThePaperStates) {
  for (double s = 0.0; s <= 1.0; s += 0.25)
    for (double t = 0.0; t <= 1.0; t += 0.125)
      for (double p : {1.0, 2.0, 3.0, 4.0}) {
        const BiasOptions options{s, t, p};
        EXPECT_DOUBLE_EQ(computeBias(0.0, options), 0.0);
        EXPECT_DOUBLE_EQ(computeBias(1.0, options), 1.0);
        double last = 0.0;
        for (double mu = 0.0; mu <= 1.0; mu += 1.0 / 256) {
          const double bias = computeBias(mu, options);
          EXPECT_GE(bias, last - 1e-12) << "decreases at " << mu;
          if (mu <= t) {
            EXPECT_LE(bias, mu + 1e-12) << "not aggressive below t";
          }
          if (mu >= t) {
            EXPECT_GE(bias, mu - 1e-12) << "not conservative above t";
          }
          if (s == 0.0) {
            EXPECT_NEAR(bias, mu, 1e-12);
          }
          const BiasOptions lower{s, t - 0.125, p};
          if (t > 0.0) {
            EXPECT_GE(computeBias(mu, lower), bias - 1e-12) << "t is not monotone";
          }
          last = bias;
        }
      }
}

TEST(Bias, EqualsTheValuesWorkedByHand) {
  EXPECT_NEAR(computeBias(0.1, {1.0, 0.25, 2.0}), 0.040, 5e-4);
  EXPECT_NEAR(computeBias(0.5, {1.0, 0.25, 2.0}), 0.667, 5e-4);
  EXPECT_NEAR(computeBias(0.3, {0.5, 0.25, 2.0}), 0.323, 5e-4);
  EXPECT_DOUBLE_EQ(computeBias(1.7, {}), 1.0);
}

}  // namespace
}  // namespace hlodbench
