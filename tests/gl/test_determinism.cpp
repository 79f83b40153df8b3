// With a fixed latency the counts are the same in every run, and on every context of one driver.
#include "gl_fixture.h"
#include "gl_replay.h"
#include "metrics/environment.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

class Determinism : public GlTest {
 protected:
  static void expectSameCounts(const std::string& strategy) {
    const Hierarchy courtyard = buildSmallCourtyard();
    const Session session = makeWalk(40, 128, 96);
    Rig rig(courtyard, session);
    for (const auto& [latency, runs] : {std::pair("draws:8", 10), std::pair("frames:1", 3)}) {
      const std::vector<double> first = exactCounts(rig.replay(strategy, latency));
      ASSERT_EQ(first.size() % session.poses.size(), 0u);
      for (int run = 1; run < runs; ++run)
        ASSERT_EQ(exactCounts(rig.replay(strategy, latency)), first)
            << strategy << " at " << latency << ", run " << run;
    }
  }
};

TEST_F(Determinism, BoolCountsTheSameInEveryRun) {
  expectSameCounts("bool");
}
TEST_F(Determinism, StopAndWaitCountsTheSameInEveryRun) {
  expectSameCounts("sw-b");
}
TEST_F(Determinism, SimpCountsTheSameInEveryRun) {
  expectSameCounts("simp-b");
}
TEST_F(Determinism, CohCountsTheSameInEveryRun) {
  expectSameCounts("coh-b");
}

TEST(Contexts, OfTheSameSoftwareRasteriserGiveTheSameCounts) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session session = makeWalk(12, 160, 120);
  std::vector<std::vector<double>> counts;
  for (const char* name : {"egl", "osmesa"}) {
    std::string reason;
    const auto context = tryContext(name, reason);
    if (context == nullptr) GTEST_SKIP() << "NO " << name << ", NOTHING COMPARED: " << reason;
    if (!isSoftwareRenderer(context->renderer))
      GTEST_SKIP() << name << " IS " << context->renderer << ", NOT SOFTWARE: NOTHING COMPARED";
    Rig rig(courtyard, session);
    std::vector<double> all;
    for (const StrategyInfo& info : listStrategies()) {
      const auto more = exactCounts(rig.replay(std::string(info.name), "draws:8"));
      all.insert(all.end(), more.begin(), more.end());
    }
    counts.push_back(std::move(all));
  }
  EXPECT_EQ(counts[0], counts[1]);
}

}  // namespace
}  // namespace hlodbench
