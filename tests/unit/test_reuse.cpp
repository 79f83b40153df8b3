// Reuse(B): it never waits in the frame of a query, settles on the front of SW(B), and asks less.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "random_tree.h"

namespace hlodbench {
namespace {

using Type = TraceEvent::Type;

TEST(Reuse, ReadsNoResultInTheFrameOfItsQuery) {
  std::mt19937 random(21);
  int read = 0;
  for (int round = 0; round < 30; ++round) {
    TinyTree tree = makeRandomTree(random);
    ScriptedRun run(tree, "reuse-b", 3);
    for (int frame = 0; frame < 12; ++frame) {
      shakeVisibility(tree, random);
      run.renderFrame();
      std::set<NodeId> queried;
      for (const TraceEvent& e : run.trace) {
        if (e.type == Type::kQuery) queried.insert(e.node);
        if (e.type != Type::kResult) continue;
        ++read;
        ASSERT_FALSE(queried.contains(e.node)) << "node " << e.node;
      }
    }
  }
  EXPECT_GT(read, 1000);
}

TEST(Reuse, DrawsAndAsksTheSameAtAnyLatency) {
  std::mt19937 random(22);
  for (int round = 0; round < 30; ++round) {
    TinyTree tree = makeRandomTree(random);
    ScriptedRun atOnce(tree, "reuse-b", 0);
    ScriptedRun late(tree, "reuse-b", 1000);
    for (int frame = 0; frame < 12; ++frame) {
      shakeVisibility(tree, random);
      ASSERT_EQ(atOnce.renderFrame(), late.renderFrame()) << "frame " << frame;
    }
  }
}

TEST(Reuse, SettlesOnTheFrontOfStopAndWaitAndThenAsksLess) {
  std::mt19937 random(23);
  int asked = 0;
  int askedByStopAndWait = 0;
  for (int round = 0; round < 100; ++round) {
    TinyTree tree = makeRandomTree(random);
    shakeVisibility(tree, random);
    ScriptedRun sw(tree, "sw-b", 0);
    sw.renderFrame();
    ScriptedRun reuse(tree, "reuse-b", 0);
    for (int frame = 0; frame < 30; ++frame) {
      reuse.renderFrame();
      if (frame < 20) continue;
      EXPECT_THAT(reuse.listDrawn(), ::testing::UnorderedElementsAreArray(sw.listDrawn()))
          << "round " << round << ", frame " << frame;
      asked += reuse.count(Counter::kQueries);
      askedByStopAndWait += sw.count(Counter::kQueries);
    }
  }
  EXPECT_LT(asked, 0.8 * askedByStopAndWait);
}

}  // namespace
}  // namespace hlodbench
