#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "metrics/mann_whitney.h"

namespace hlodbench {
namespace {

using Sample = std::vector<double>;

// Pairs with b > a, ties counted half: the definition of U.
double countPairs(const Sample& a, const Sample& b) {
  double u = 0.0;
  for (const double x : a)
    for (const double y : b) u += y > x ? 1.0 : y == x ? 0.5 : 0.0;
  return u;
}

// p by dealing the values to the samples in every way there is.
double enumerateP(const Sample& a, const Sample& b) {
  Sample all = a;
  all.insert(all.end(), b.begin(), b.end());
  const double ours = countPairs(a, b);
  int below = 0;
  int above = 0;
  int ways = 0;
  std::vector<int> isB(all.size(), 0);
  std::fill(isB.end() - static_cast<std::ptrdiff_t>(b.size()), isB.end(), 1);
  do {
    Sample dealtA, dealtB;
    for (std::size_t i = 0; i < all.size(); ++i) (isB[i] ? dealtB : dealtA).push_back(all[i]);
    const double u = countPairs(dealtA, dealtB);
    ++ways;
    below += u <= ours ? 1 : 0;
    above += u >= ours ? 1 : 0;
  } while (std::next_permutation(isB.begin(), isB.end()));
  return std::min(1.0, 2.0 * std::min(below, above) / ways);
}

Sample drawSample(std::mt19937_64& engine, std::size_t count, std::uint64_t levels) {
  Sample sample(count);
  for (double& value : sample) value = static_cast<double>(engine() % levels);
  return sample;
}

// 0, 1, 2, ... without `swapped` pairs in the wrong order: U of b over a is n m - swapped.
double computePOfU(std::size_t n, std::size_t m, std::size_t u) {
  // b takes the lowest places, then moves up place by place until u pairs are right
  std::vector<std::size_t> places(m);
  for (std::size_t i = 0; i < m; ++i) places[i] = i;
  for (std::size_t i = m; i-- > 0;) {
    const std::size_t step = std::min(u, n);
    places[i] += step;
    u -= step;
  }
  Sample a, b;
  for (std::size_t place = 0; place < n + m; ++place)
    (std::find(places.begin(), places.end(), place) != places.end() ? b : a)
        .push_back(static_cast<double>(place));
  return computeMannWhitney(a, b).p;
}

}  // namespace

TEST(MannWhitney, HasThePublishedCriticalValues) {
  // The largest U that is significant on both sides at 0.05, as printed in tables of the test.
  struct {
    std::size_t n, m, u;
  } const table[] = {{4, 4, 0},     {5, 5, 2},  {6, 6, 5},    {7, 7, 8},
                     {8, 8, 13},    {9, 9, 17}, {10, 10, 23}, {15, 15, 64},
                     {20, 20, 127}, {5, 8, 6},  {6, 10, 11},  {10, 20, 55}};
  for (const auto& [n, m, u] : table) {
    EXPECT_LE(computePOfU(n, m, u), 0.05) << n << " " << m;
    EXPECT_GT(computePOfU(n, m, u + 1), 0.05) << n << " " << m;
  }
}

TEST(MannWhitney, AgreesWithTheExampleOfSciPysManual) {
  // scipy.stats.mannwhitneyu: U1 = 17, p = 0.1111
  const Sample males{19, 22, 16, 29, 24};
  const Sample females{20, 11, 17, 12};
  const MannWhitney test = computeMannWhitney(females, males);
  EXPECT_DOUBLE_EQ(test.u, 17.0);
  EXPECT_NEAR(test.p, 1.0 / 9.0, 1e-12);
  EXPECT_TRUE(test.isExact);
}

TEST(MannWhitney, AgreesWithSciPyWhereItApproximates) {
  // scipy 1.10: mannwhitneyu(b, a, method="asymptotic")
  Sample a, b, tiedA, tiedB;
  for (int i = 0; i < 40; ++i) {
    a.push_back(i * 37 % 101);
    tiedA.push_back(i % 7);
  }
  for (int i = 0; i < 35; ++i) {
    b.push_back(i * 53 % 97 + 6);
    tiedB.push_back(i * 3 % 8);
  }
  EXPECT_FALSE(computeMannWhitney(a, b).isExact);
  EXPECT_DOUBLE_EQ(computeMannWhitney(a, b).u, 710.0);
  EXPECT_NEAR(computeMannWhitney(a, b).p, 0.9196318132527183, 1e-12);
  EXPECT_DOUBLE_EQ(computeMannWhitney(tiedA, tiedB).u, 801.5);
  EXPECT_NEAR(computeMannWhitney(tiedA, tiedB).p, 0.27920065630924495, 1e-12);
}

TEST(MannWhitney, CountsEveryDealOfSmallSamplesTiedOrNot) {
  std::mt19937_64 engine(5);
  int tied = 0;
  for (int round = 0; round < 60; ++round) {
    const Sample a = drawSample(engine, 1 + engine() % 5, round % 2 ? 4 : 1000);
    const Sample b = drawSample(engine, 1 + engine() % 5, round % 2 ? 4 : 1000);
    const MannWhitney test = computeMannWhitney(a, b);
    EXPECT_DOUBLE_EQ(test.u, countPairs(a, b));
    EXPECT_NEAR(test.p, enumerateP(a, b), 1e-12);
    tied += test.u != std::floor(test.u) ? 1 : 0;
  }
  EXPECT_GT(tied, 5);
}

TEST(MannWhitney, IsSymmetricAndKnowsNoUnit) {
  std::mt19937_64 engine(6);
  for (const std::size_t size : {4u, 9u, 40u}) {
    for (const std::uint64_t levels : {5u, 100000u}) {
      const Sample a = drawSample(engine, size, levels);
      const Sample b = drawSample(engine, size + 3, levels);
      const MannWhitney ab = computeMannWhitney(a, b);
      const MannWhitney ba = computeMannWhitney(b, a);
      EXPECT_DOUBLE_EQ(ab.u + ba.u, static_cast<double>(a.size() * b.size()));
      EXPECT_NEAR(ab.p, ba.p, 1e-12);
      EXPECT_NEAR(ab.a12 + ba.a12, 1.0, 1e-12);
      Sample shiftedA = a;
      Sample shiftedB = b;
      for (double& value : shiftedA) value = 3.0 * value + 17.0;
      for (double& value : shiftedB) value = 3.0 * value + 17.0;
      EXPECT_DOUBLE_EQ(computeMannWhitney(shiftedA, shiftedB).p, ab.p);
      EXPECT_DOUBLE_EQ(computeMannWhitney(shiftedA, shiftedB).u, ab.u);
    }
  }
}

TEST(MannWhitney, ApproachesTheExactValueWhereItStartsToApproximate) {
  // 30 against 30 is exact, 31 against 31 not: two halves of one sequence, b a little higher
  const auto compute = [](int size) {
    Sample a, b;
    for (int i = 0; i < size; ++i) {
      a.push_back(i);
      b.push_back(i + 7.5);
    }
    return computeMannWhitney(a, b);
  };
  EXPECT_TRUE(compute(30).isExact);
  EXPECT_FALSE(compute(31).isExact);
  EXPECT_NEAR(compute(30).p, compute(31).p, 0.01);
}

TEST(MannWhitney, CallsEqualValuesNoDifference) {
  const Sample equal(40, 3.0);
  EXPECT_DOUBLE_EQ(computeMannWhitney(Sample{3, 3}, Sample{3, 3, 3}).p, 1.0);
  EXPECT_DOUBLE_EQ(computeMannWhitney(equal, equal).p, 1.0);
  EXPECT_DOUBLE_EQ(computeMannWhitney(equal, equal).a12, 0.5);
}

TEST(MannWhitney, KnowsTheSmallestP) {
  EXPECT_NEAR(computeSmallestP(3, 3), 0.1, 1e-12);
  EXPECT_NEAR(computeSmallestP(5, 5), 2.0 / 252.0, 1e-12);
  EXPECT_DOUBLE_EQ(computeSmallestP(1, 1), 1.0);
  for (std::size_t n = 1; n < 7; ++n)
    for (std::size_t m = 1; m < 7; ++m) {
      EXPECT_NEAR(computeSmallestP(n, m), computePOfU(n, m, 0), 1e-12);
    }
  EXPECT_EQ(computeNeededRepetitions(0.05), 4u);
  EXPECT_EQ(computeNeededRepetitions(0.001), 7u);
}

TEST(MannWhitney, RefusesWhatCannotBeRanked) {
  const Sample one{1.0};
  EXPECT_THROW(computeMannWhitney({}, one), std::invalid_argument);
  EXPECT_THROW(computeMannWhitney(one, Sample{std::numeric_limits<double>::quiet_NaN()}),
               std::invalid_argument);
}

}  // namespace hlodbench
