#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "hlod/view/camera.h"

namespace hlodbench {

// Bit by bit.
inline bool isSame(const Pose& a, const Pose& b) {
  return std::memcmp(&a, &b, sizeof(Pose)) == 0;
}

// q and -q are one orientation.
inline void expectNear(const Pose& a, const Pose& b, double tolerance = 1e-9) {
  EXPECT_NEAR(glm::distance(a.position, b.position), 0.0, tolerance);
  EXPECT_NEAR(std::abs(glm::dot(a.orientation, b.orientation)), 1.0, tolerance);
  EXPECT_NEAR(glm::length(a.orientation), 1.0, 1e-14);
}

}  // namespace hlodbench
