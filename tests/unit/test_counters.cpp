#include <gtest/gtest.h>

#include "metrics/counters.h"

namespace hlodbench {

TEST(CounterTable, StandsInTheOrderOfTheEnum) {
  for (std::size_t i = 0; i < kCounterCount; ++i)
    EXPECT_EQ(static_cast<std::size_t>(kCounterTable[i].counter), i);
}

TEST(FrameRecord, HoldsNoValueUntilOneIsSet) {
  FrameRecord record;
  EXPECT_FALSE(record.has(Counter::kGpuMs));
  record.set(Counter::kGpuMs, 0.0);
  EXPECT_TRUE(record.has(Counter::kGpuMs));
}

}  // namespace hlodbench
