#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>

#include "metrics/verdict.h"

namespace hlodbench {
namespace {

using Sample = std::vector<double>;
using testing::HasSubstr;

// Normal noise that is the same with every standard library.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}
  double draw() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }
  // Frame times around `mean` that scatter by this share of it.
  Sample drawTimes(std::size_t count, double mean, double share) {
    Sample times(count);
    for (double& time : times) time = mean * (1.0 + share * draw());
    return times;
  }

 private:
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  std::mt19937_64 engine_;
};

// How often runs of the same thing, or of one that is slower by a share, are told apart.
struct Rates {
  int better = 0, worse = 0, same = 0, significant = 0;
};
Rates simulate(int rounds, std::size_t repetitions, double slowdown, double noise, bool paired) {
  Rates rates;
  Noise source(42);
  for (int round = 0; round < rounds; ++round) {
    Sample a = source.drawTimes(repetitions, 16.0, noise);
    Sample b = source.drawTimes(repetitions, 16.0 * (1.0 + slowdown), noise);
    const NoisyComparison c = compareNoisy(a, b, Better::kLower, paired);
    rates.better += c.judgement.verdict == Verdict::kBetter ? 1 : 0;
    rates.worse += c.judgement.verdict == Verdict::kWorse ? 1 : 0;
    rates.same += c.judgement.verdict == Verdict::kSame ? 1 : 0;
    rates.significant += c.test.p < 0.05 ? 1 : 0;
  }
  return rates;
}

}  // namespace

TEST(Verdict, RaisesNoMoreFalseAlarmsThanAlpha) {
  for (const bool paired : {false, true})
    for (const std::size_t repetitions : {4u, 5u}) {
      const Rates rates = simulate(200, repetitions, 0.0, 0.02, paired);
      EXPECT_LE(rates.better + rates.worse, 10) << repetitions;  // 0.05 of 200
      EXPECT_LE(rates.better + rates.worse, rates.significant);
    }
}

TEST(Verdict, RestsOnATestThatKeepsAlpha) {
  for (const std::uint64_t levels : {0u, 3u})  // values that are all different, or mostly tied
    for (const std::size_t repetitions : {4u, 5u, 6u, 7u}) {
      Noise noise(7);
      int alarms = 0;
      for (int round = 0; round < 4000; ++round) {
        Sample a = noise.drawTimes(repetitions, 16.0, 0.02);
        Sample b = noise.drawTimes(repetitions, 16.0, 0.02);
        if (levels > 0)
          for (Sample* sample : {&a, &b})
            for (double& value : *sample) value = std::round(value * static_cast<double>(levels));
        alarms += computeMannWhitney(a, b).p < 0.05 ? 1 : 0;
      }
      EXPECT_LE(alarms, 200) << repetitions << " " << levels;
      EXPECT_GT(alarms, 20) << "a test that never speaks keeps any alpha";
    }
}

TEST(Verdict, FindsAChangeThatIsThere) {
  const Rates slower = simulate(100, 5, 0.05, 0.01, false);
  EXPECT_GE(slower.worse, 95);
  EXPECT_EQ(slower.better + slower.same, 0);
  const Rates faster = simulate(100, 5, -0.05, 0.01, true);
  EXPECT_GE(faster.better, 95);
  EXPECT_EQ(faster.worse + faster.same, 0);
}

TEST(Verdict, CallsAQuietRunOfTheSameThingSame) {
  const Rates rates = simulate(100, 5, 0.0, 0.002, false);
  EXPECT_GE(rates.same, 95);
  EXPECT_EQ(rates.better + rates.worse, 0);
}

TEST(Verdict, SaysHowManyRepetitionsItWants) {
  const NoisyComparison c =
      compareNoisy(Sample{1, 2, 3}, Sample{101, 102, 103}, Better::kLower, false);
  EXPECT_EQ(c.judgement.verdict, Verdict::kUnclear);
  EXPECT_THAT(c.judgement.reason, HasSubstr("3 against 3 give p = 0.1 at least; 4 each"));
  // the same values are no more telling for being equal
  const NoisyComparison equal = compareNoisy(Sample{1, 1}, Sample{1, 1}, Better::kLower, false);
  EXPECT_EQ(equal.judgement.verdict, Verdict::kUnclear);
}

TEST(Verdict, GoesByTheDirectionOfTheCounter) {
  const Sample low{10, 10.1, 10.2, 10.3};
  const Sample high{20, 20.1, 20.2, 20.3};
  const auto judge = [](const Sample& a, const Sample& b, Better better) {
    return compareNoisy(a, b, better, false).judgement.verdict;
  };
  EXPECT_EQ(judge(low, high, Better::kLower), Verdict::kWorse);
  EXPECT_EQ(judge(high, low, Better::kLower), Verdict::kBetter);
  EXPECT_EQ(judge(low, high, Better::kHigher), Verdict::kBetter);
  EXPECT_EQ(judge(high, low, Better::kHigher), Verdict::kWorse);
  EXPECT_EQ(judge(low, high, Better::kNeither), Verdict::kUnclear);
}

TEST(Verdict, WantsAChangeOfSomeSizeAndAnEffectOfSomeSize) {
  const Sample a{100.0, 100.1, 100.2, 100.3, 100.4};
  const Sample b{100.5, 100.6, 100.7, 100.8, 100.9};  // 0.5 %, wholly above
  VerdictOptions options;
  EXPECT_EQ(compareNoisy(a, b, Better::kLower, false, options).judgement.verdict, Verdict::kSame);
  options.minChange = 0.001;
  EXPECT_EQ(compareNoisy(a, b, Better::kLower, false, options).judgement.verdict, Verdict::kWorse);
  options.minChange = 0.005;
  const auto between = compareNoisy(a, b, Better::kLower, false, options).judgement;
  EXPECT_EQ(between.verdict, Verdict::kUnclear);
  EXPECT_THAT(between.reason, HasSubstr("within +-0.5 %, but"));

  // many repetitions that overlap: significant, but no large effect
  Sample manyA, manyB;
  for (int i = 0; i < 100; ++i) {
    manyA.push_back(10.0 + 0.1 * i);
    manyB.push_back(11.2 + 0.1 * i);
  }
  const NoisyComparison c = compareNoisy(manyA, manyB, Better::kLower, false);
  EXPECT_LT(c.test.p, 0.05);
  EXPECT_LT(c.test.a12, kLargeA12);
  EXPECT_EQ(c.judgement.verdict, Verdict::kUnclear);
  EXPECT_THAT(c.judgement.reason, HasSubstr("no effect of 0.71"));
  options.effect = 0.6;
  options.minChange = 0.01;
  EXPECT_EQ(compareNoisy(manyA, manyB, Better::kLower, false, options).judgement.verdict,
            Verdict::kWorse);
}

TEST(Verdict, PairsRepetitionsThatDriftTogether) {
  // The machine gets slower and slower; b takes 3 % more in each repetition.
  Sample a, b;
  for (int i = 0; i < 6; ++i) {
    a.push_back(10.0 + 0.05 * i);
    b.push_back(a.back() * 1.03);
  }
  const NoisyComparison c = compareNoisy(a, b, Better::kLower, true);
  EXPECT_EQ(c.judgement.verdict, Verdict::kWorse);
  EXPECT_NEAR(*c.change.relative->low, 0.03, 1e-9);
  EXPECT_NEAR(*c.change.relative->high, 0.03, 1e-9);
}

TEST(Verdict, TakesAnyClearChangeFromZeroAsLarge) {
  const Sample none(5, 0.0);
  const NoisyComparison c = compareNoisy(none, Sample{1, 2, 3, 4, 5}, Better::kLower, false);
  EXPECT_EQ(c.judgement.verdict, Verdict::kWorse);
  EXPECT_FALSE(c.change.relative);
  EXPECT_EQ(compareNoisy(none, Sample{0, 0, 0, 0, 1}, Better::kLower, false).judgement.verdict,
            Verdict::kUnclear);
  EXPECT_EQ(compareNoisy(none, none, Better::kLower, false).judgement.verdict, Verdict::kSame);
}

}  // namespace hlodbench
