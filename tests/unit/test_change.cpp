#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "metrics/change.h"

namespace hlodbench {
namespace {

using Sample = std::vector<double>;

Sample drawSample(std::uint64_t seed, std::size_t count, double low, double high) {
  std::mt19937_64 engine(seed);
  Sample sample(count);
  for (double& value : sample)
    value = low + (high - low) * static_cast<double>(engine() >> 11) * 0x1.0p-53;
  return sample;
}

void expectOrdered(const Interval& interval) {
  ASSERT_TRUE(interval.low && interval.high);
  EXPECT_LE(*interval.low, interval.value);
  EXPECT_GE(*interval.high, interval.value);
}

BootstrapOptions few() {
  BootstrapOptions options;
  options.resamples = 1000;
  return options;
}

}  // namespace

TEST(MeanChange, OfAConstantDifferenceIsThatDifferenceAlone) {
  const Sample a = drawSample(1, 50, 10, 90);
  Sample b = a;
  for (double& value : b) value += 3.0;
  const Change change = computeMeanChange(a, b, few());
  EXPECT_NEAR(change.absolute.value, 3.0, 1e-9);
  EXPECT_NEAR(*change.absolute.low, 3.0, 1e-9);
  EXPECT_NEAR(*change.absolute.high, 3.0, 1e-9);
  expectOrdered(*change.relative);
  EXPECT_LT(*change.relative->low, *change.relative->high);
}

TEST(MeanChange, OfAConstantRatioIsThatRatioAlone) {
  const Sample a = drawSample(2, 50, 10, 90);
  Sample b = a;
  for (double& value : b) value *= 1.25;
  const Change change = computeMeanChange(a, b, few());
  EXPECT_NEAR(*change.relative->low, 0.25, 1e-9);
  EXPECT_NEAR(*change.relative->high, 0.25, 1e-9);
}

TEST(MeanChange, HasTheIntervalOfTheNormalApproximation) {
  // For many frames the bootstrap interval of a mean approaches mean +- 1.96 standard errors.
  const Sample a = drawSample(3, 400, 0, 100);
  const Sample b = drawSample(4, 400, 0, 100);
  double mean = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) mean += (b[i] - a[i]) / 400.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += std::pow(b[i] - a[i] - mean, 2) / 399.0;
  const double error = 1.96 * std::sqrt(squares / 400.0);
  const Change change = computeMeanChange(a, b);
  EXPECT_NEAR(change.absolute.value, mean, 1e-9);
  EXPECT_NEAR(*change.absolute.low, mean - error, 0.1 * error);
  EXPECT_NEAR(*change.absolute.high, mean + error, 0.1 * error);
}

TEST(MeanChange, HasNoRelativePartWhereAMeanMayBeZero) {
  EXPECT_FALSE(computeMeanChange(Sample{0, 0, 0, 1}, Sample{1, 1, 1, 1}, few()).relative);
  EXPECT_FALSE(computeMeanChange(Sample{0, 0}, Sample{0, 0}, few()).relative);
}

TEST(MedianChange, GoesTheOtherWayWhenTheSamplesSwap) {
  const Sample a = drawSample(5, 8, 10, 11);
  const Sample b = drawSample(6, 7, 12, 13);
  const Change ab = computeMedianChange(a, b, few());
  const Change ba = computeMedianChange(b, a, few());
  EXPECT_DOUBLE_EQ(ab.absolute.value, -ba.absolute.value);
  EXPECT_NEAR(ab.relative->value, 1.0 / (1.0 + ba.relative->value) - 1.0, 1e-12);
  expectOrdered(ab.absolute);
  EXPECT_GT(*ab.absolute.low, 0.0);
  EXPECT_LT(*ba.absolute.high, 0.0);
}

TEST(MedianChange, StaysWithinTheRangeOfTheSamplesWhateverTheirOrder) {
  Sample a = drawSample(7, 5, 10, 11);
  Sample b = drawSample(8, 5, 10, 11);
  const Change change = computeMedianChange(a, b, few());
  const auto [lowA, highA] = std::minmax_element(a.begin(), a.end());
  const auto [lowB, highB] = std::minmax_element(b.begin(), b.end());
  EXPECT_GE(*change.absolute.low, *lowB - *highA);
  EXPECT_LE(*change.absolute.high, *highB - *lowA);
  std::reverse(a.begin(), a.end());
  std::reverse(b.begin(), b.end());
  EXPECT_EQ(computeMedianChange(a, b, few()).absolute, change.absolute);
}

TEST(PairedMedianChange, TakesTheRatioWithinEachPair) {
  const Sample a{10, 20, 40, 80};
  const Sample b{11, 22, 44, 88};
  const Change change = computePairedMedianChange(a, b, few());
  EXPECT_NEAR(change.relative->value, 0.1, 1e-12);
  EXPECT_NEAR(*change.relative->low, 0.1, 1e-12);
  EXPECT_NEAR(*change.relative->high, 0.1, 1e-12);
  EXPECT_NEAR(change.absolute.value, 3.0, 1e-12);
  EXPECT_GT(*computeMedianChange(a, b, few()).relative->high, 0.5) << "unpaired it is not seen";
}

TEST(AnyChange, OfSingleValuesHasNoInterval) {
  for (const auto compute : {computeMeanChange, computeMedianChange, computePairedMedianChange}) {
    const Change change = compute(Sample{2}, Sample{3}, few());
    EXPECT_DOUBLE_EQ(change.absolute.value, 1.0);
    EXPECT_DOUBLE_EQ(change.relative->value, 0.5);
    EXPECT_FALSE(change.absolute.low || change.absolute.high || change.relative->low);
  }
}

TEST(AnyChange, RefusesWhatIsNoSample) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto compute : {computeMeanChange, computeMedianChange, computePairedMedianChange}) {
    EXPECT_THROW(compute({}, {}, few()), std::invalid_argument);
    EXPECT_THROW(compute(Sample{1}, Sample{infinity}, few()), std::invalid_argument);
  }
  EXPECT_THROW(computeMeanChange(Sample{1, 2}, Sample{1}, few()), std::invalid_argument);
  EXPECT_THROW(computePairedMedianChange(Sample{1, 2}, Sample{1}, few()), std::invalid_argument);
}

}  // namespace hlodbench
