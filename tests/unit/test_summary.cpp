#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "metrics/summary.h"

namespace hlodbench {
namespace {

FrameRecord makeFrame(int frame, Counter counter, double value) {
  FrameRecord record;
  record.frame = frame;
  record.set(counter, value);
  return record;
}

std::vector<FrameRecord> makeFrames(Counter counter, const std::vector<double>& values) {
  std::vector<FrameRecord> records;
  for (const double value : values)
    records.push_back(makeFrame(static_cast<int>(records.size()), counter, value));
  return records;
}

}  // namespace

TEST(Quantile, InterpolatesBetweenOrderStatisticsAsNumPyDoes) {
  const std::vector<double> sorted{1.0, 2.0, 4.0, 8.0};
  EXPECT_DOUBLE_EQ(computeQuantile(sorted, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(computeQuantile(sorted, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(computeQuantile(sorted, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(computeQuantile(sorted, 0.99), 7.88);
  EXPECT_DOUBLE_EQ(computeQuantile(sorted, 1.0), 8.0);
  EXPECT_THROW(computeQuantile(std::vector<double>{}, 0.5), std::invalid_argument);
}

TEST(Summary, StatesWhatAHandComputationGives) {
  const Summary summary = computeSummary(makeFrames(Counter::kDn, {8.0, 1.0, 4.0, 2.0}));
  const auto& dn = summary.get(Counter::kDn);
  ASSERT_TRUE(dn);
  EXPECT_EQ(summary.frames, 4u);
  EXPECT_EQ(dn->count, 4u);
  EXPECT_DOUBLE_EQ(dn->mean, 3.75);
  EXPECT_DOUBLE_EQ(dn->median, 3.0);
  EXPECT_DOUBLE_EQ(dn->min, 1.0);
  EXPECT_DOUBLE_EQ(dn->max, 8.0);
  EXPECT_DOUBLE_EQ(dn->q1, 1.75);
  EXPECT_DOUBLE_EQ(dn->q3, 5.0);
  EXPECT_DOUBLE_EQ(dn->p99, 7.88);
  EXPECT_NEAR(dn->stddev, 3.0956959368344519, 1e-14);
}

TEST(Summary, IgnoresWarmUpFramesEverywhere) {
  std::vector<FrameRecord> records = makeFrames(Counter::kFrameMs, {1000.0, 10.0, 10.0});
  records[0].warmUp = true;
  records[0].set(Counter::kDn, 1e9);
  records[0].set(Counter::kD, 1e9);
  records[1].set(Counter::kDn, 100.0);
  records[1].set(Counter::kD, 2.0);
  const Summary summary = computeSummary(records);
  EXPECT_EQ(summary.frames, 2u);
  EXPECT_EQ(summary.warmUpFrames, 1u);
  EXPECT_DOUBLE_EQ(summary.get(Counter::kDn)->mean, 100.0);
  EXPECT_DOUBLE_EQ(*summary.fps, 100.0);
  EXPECT_DOUBLE_EQ(*summary.fpsFrameMean, 100.0);
  EXPECT_DOUBLE_EQ(*summary.delayedShare, 0.02);
}

TEST(Summary, KeepsAbsentCountersAbsentAndCountsTheFramesThatHaveOne) {
  std::vector<FrameRecord> records = makeFrames(Counter::kDn, {3.0, 5.0, 7.0});
  records[1].set(Counter::kGpuMs, 0.0);  // measured to be nothing is not absent
  const Summary summary = computeSummary(records);
  EXPECT_FALSE(summary.get(Counter::kRarn));
  EXPECT_FALSE(summary.get(Counter::kFrameMs));
  ASSERT_TRUE(summary.get(Counter::kGpuMs));
  EXPECT_EQ(summary.get(Counter::kGpuMs)->count, 1u);
  EXPECT_EQ(summary.get(Counter::kGpuMs)->mean, 0.0);
  EXPECT_EQ(summary.get(Counter::kGpuMs)->stddev, 0.0);
  EXPECT_FALSE(summary.fps);
  EXPECT_FALSE(summary.fpsFrameMean);
  EXPECT_FALSE(summary.delayedShare);
}

TEST(Summary, OfNoFrameHoldsNothing) {
  const Summary summary = computeSummary({});
  EXPECT_EQ(summary.frames, 0u);
  EXPECT_TRUE(std::none_of(summary.counters.begin(), summary.counters.end(),
                           [](const auto& counter) { return counter.has_value(); }));
  EXPECT_FALSE(summary.fps);
}

TEST(Summary, TellsTheTwoFpsDefinitionsApart) {
  // 10 ms and 30 ms: 2 frames in 40 ms are 50 FPS; the mean of 100 and 33.3 is 66.7.
  const Summary summary = computeSummary(makeFrames(Counter::kFrameMs, {10.0, 30.0}));
  EXPECT_DOUBLE_EQ(*summary.fps, 50.0);
  EXPECT_NEAR(*summary.fpsFrameMean, 200.0 / 3.0, 1e-12);
}

TEST(Summary, GivesNoFpsForAFrameThatTookNoTime) {
  const Summary summary = computeSummary(makeFrames(Counter::kFrameMs, {10.0, 0.0}));
  EXPECT_FALSE(summary.fps);
  EXPECT_FALSE(summary.fpsFrameMean);
}

TEST(Summary, ComputesTheDelayedShareFromTotalsNotFromFrameShares) {
  std::vector<FrameRecord> records = makeFrames(Counter::kDn, {10.0, 190.0});
  records[0].set(Counter::kD, 5.0);
  records[1].set(Counter::kD, 0.0);
  EXPECT_DOUBLE_EQ(*computeSummary(records).delayedShare, 0.025);
}

TEST(Summary, OrdersItsQuantilesAndItsFpsOnAnySample) {
  std::mt19937_64 engine(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> values(1 + engine() % 300);
    for (double& value : values) value = 0.01 + static_cast<double>(engine() % 100000) / 1000.0;
    const Summary summary = computeSummary(makeFrames(Counter::kFrameMs, values));
    const CounterSummary ms = *summary.get(Counter::kFrameMs);
    const std::vector<double> ordered{ms.min, ms.q1, ms.median, ms.q3, ms.p99, ms.max};
    EXPECT_TRUE(std::is_sorted(ordered.begin(), ordered.end()));
    EXPECT_GE(ms.mean, ms.min);
    EXPECT_LE(ms.mean, ms.max);
    // The arithmetic mean of rates is never below the harmonic one (total over total).
    EXPECT_GE(*summary.fpsFrameMean, *summary.fps * (1.0 - 1e-12));
    EXPECT_NEAR(*summary.fps, 1000.0 / ms.mean, 1e-6 * *summary.fps);
    std::shuffle(values.begin(), values.end(), engine);
    EXPECT_NEAR(computeSummary(makeFrames(Counter::kFrameMs, values)).get(Counter::kFrameMs)->q3,
                ms.q3, 1e-12);
  }
}

}  // namespace hlodbench
