#include "test_slowdown.h"

#include <gtest/gtest.h>

#include "hlod/core/error.h"

namespace hlodbench {

TEST(Slowdown, ReadsPercentsOfStages) {
  const Slowdown none = parseSlowdown("");
  EXPECT_FALSE(none.isAny());
  const Slowdown some = parseSlowdown("draw=5,traversal=12.5");
  EXPECT_DOUBLE_EQ(some.draw, 0.05);
  EXPECT_DOUBLE_EQ(some.query, 0.0);
  EXPECT_DOUBLE_EQ(some.traversal, 0.125);
  EXPECT_TRUE(some.isAny());
  EXPECT_EQ(describeSlowdown(some),
            "slowed down for a test (HLODBENCH_TEST_SLOWDOWN): draw by 5 %, traversal by 12.5 %");
  EXPECT_TRUE(parseSlowdown("query=10").isAny());
}

TEST(Slowdown, RefusesWhatItDoesNotUnderstand) {
  for (const char* text : {"draw", "draw=", "draw=x", "draw=-1", "draw=1001", "draw=nan", "draw=5 ",
                           "sleep=5", "draw=5,", ",draw=5", "draw=5;query=5", "=5"}) {
    try {
      parseSlowdown(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find("HLODBENCH_TEST_SLOWDOWN: expected"), 0u) << text;
    }
  }
}

// A lower bound, which holds however busy the machine is.
TEST(Slowdown, SpinsForAtLeastTheShare) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  spin(std::chrono::milliseconds(20), 0.5);
  EXPECT_GE(Clock::now() - start, std::chrono::milliseconds(10));
}

}  // namespace hlodbench
