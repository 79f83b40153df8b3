#include "view/picking.h"

#include <gtest/gtest.h>

#include <random>

namespace hlodbench {

// The inverse of what the camera's matrix does.
TEST(Picking, FindsThePointThatProjectsToThePixel) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    Lens lens;
    lens.width = 100 + static_cast<int>(random() % 900);
    lens.height = 100 + static_cast<int>(random() % 900);
    lens.fovyRad = 1.2 + unit(random);
    Pose pose;
    pose.position = {unit(random), unit(random), unit(random)};
    pose.orientation =
        glm::normalize(glm::dquat(unit(random), unit(random), unit(random), unit(random)));
    const Camera camera = makeCamera(lens, pose);
    const double x = lens.width * (0.5 + 0.5 * unit(random));
    const double y = lens.height * (0.5 + 0.5 * unit(random));
    const double depth = 5.0 + 4.0 * unit(random);
    const glm::dvec3 point = computePointAt(camera, x, y, depth);
    EXPECT_NEAR(glm::dot(point - pose.position, camera.forward()), depth, 1e-9);
    const glm::dvec4 clip = camera.viewProjection * glm::dvec4(point, 1.0);
    EXPECT_NEAR(0.5 * lens.width * (1.0 + clip.x / clip.w), x, 1e-6);
    EXPECT_NEAR(0.5 * lens.height * (1.0 - clip.y / clip.w), y, 1e-6);
  }
}

}  // namespace hlodbench
