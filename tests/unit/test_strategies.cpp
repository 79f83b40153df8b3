// Hand-worked frames of each strategy on tiny trees with scripted queries.
#include <gmock/gmock.h>

#include "hlod/core/error.h"
#include "tiny_tree.h"

namespace hlodbench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::uint32_t kNever = 1000;  // draws: in a tiny tree a result comes only when waited for

bool asksQueries(const ScriptedRun& run) {
  return run.record.has(Counter::kQueries);
}

TEST(Bool, FirstFrameDelaysEveryNode) {
  FiveNodes tree;
  ScriptedRun run(tree, "bool", 0);
  EXPECT_EQ(run.renderFrame(),
            "visit 0 delay, query 0, result 0 refine, "
            "visit 1 delay, query 1, result 1 refine, "
            "visit 2 delay, query 2, result 2 stop, draw 2, "
            "visit 4 delay, query 4, result 4 stop, draw 4, "
            "visit 3 delay, query 3, result 3 stop, draw 3");
}

TEST(Bool, DrawsWhatWasVisibleAtOnceAndQueriesNoVisibleInterior) {
  FiveNodes tree;
  ScriptedRun run(tree, "bool", kNever);
  run.renderFrame();
  EXPECT_EQ(run.renderFrame(),
            "visit 0 refine, visit 1 refine, "
            "visit 2 stop, query 2, draw 2, visit 4 stop, query 4, draw 4, "
            "visit 3 stop, query 3, draw 3, "
            "result 2 stop, result 4 stop, result 3 stop");
  EXPECT_EQ(run.count(Counter::kDn), 3);
  EXPECT_EQ(run.count(Counter::kQueries), 3);
  EXPECT_EQ(run.count(Counter::kDelays), 0);
}

TEST(Bool, IgnoresRelativeVisibility) {
  FiveNodes tree;
  tree.setSse(0, 1.01);
  tree.setSse(1, 0.9);
  tree.setMu(0, 0.001);
  ScriptedRun run(tree, "bool", 0);
  run.renderFrame();
  EXPECT_THAT(run.listDrawn(), ElementsAre(1, 2));
}

TEST(StopAndWait, DecidesEveryNodeByItsOwnResult) {
  FiveNodes tree;
  tree.setMu(1, 0.2);  // B(0.2) = 0.16: 0.16 * 4 <= 1
  ScriptedRun run(tree, "sw-b", kNever);
  EXPECT_EQ(run.renderFrame(),
            "visit 0 delay, query 0, result 0 refine, "
            "visit 1 delay, query 1, result 1 stop, draw 1, "
            "visit 2 delay, query 2, result 2 stop, draw 2");
  EXPECT_EQ(run.count(Counter::kD), 2);
}

TEST(StopAndWait, CullsWhatIsHiddenWithAllBelowIt) {
  FiveNodes tree;
  tree.setMu(1, 0.0);
  ScriptedRun run(tree, "sw-b", 0);
  EXPECT_THAT(run.renderFrame(), HasSubstr("result 1 hidden, visit 2"));
  EXPECT_THAT(run.listDrawn(), ElementsAre(2));
}

TEST(Simp, TakesTheBiasOfTheNodeProcessedLast) {
  FiveNodes tree;
  ScriptedRun run(tree, "simp-b", 0);
  run.renderFrame();
  // nothing processed yet: 0 and 1 are refined as by Bool; the leaf 2 gives B(0.2) = 0.16; node 1
  // had been refined before that was known
  tree.setMu(2, 0.2);
  EXPECT_EQ(run.renderFrame(),
            "visit 0 refine, visit 1 refine, visit 2 stop, query 2, draw 2, result 2 stop, "
            "visit 4 stop, query 4, draw 4, result 4 stop, visit 3 stop, query 3, draw 3, "
            "result 3 stop");
}

// A row of five under the root, taken from the middle outwards: 3, 2, 4, 1, 5. The last one, 5, has
// a leaf below each half.
struct Row : TinyTree {
  Row() {
    addChildren(0, 5);
    addChildren(5, 2);  // 6, 7
    setSse(0, 8.0);
    setSse(5, 2.0);
  }
};

TEST(Simp, StopsTooEarlyAfterAHiddenNeighbourAndRefinesAfterRendering) {
  Row tree;
  ScriptedRun run(tree, "simp-b", 0);
  run.renderFrame();
  // 1 is processed before 5 and leaves B(0.2) = 0.16, so that 5 is drawn; its own result says
  // refine
  tree.setMu(1, 0.2);
  EXPECT_THAT(run.renderFrame(),
              HasSubstr("visit 5 stop, query 5, draw 5, result 5 refine, rarn 5"));
  EXPECT_EQ(run.count(Counter::kRarn), 1);
}

TEST(Simp, VariantBAveragesTheResultsOfTheFrame) {
  Row tree;
  TraversalOptions options;
  options.simpEstimate = SimpEstimate::kRunningMean;
  ScriptedRun run(tree, "simp-b", 0, options);
  run.renderFrame();
  // biases 1, 1, 1 and 0.16 before node 5: mean 0.79, and 0.79 * 2 is above 1
  tree.setMu(1, 0.2);
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 5 refine"));
}

TEST(Coh, FirstFrameIsStopAndWait) {
  FiveNodes tree;
  ScriptedRun coh(tree, "coh-b", 0);
  ScriptedRun sw(tree, "sw-b", 0);
  EXPECT_EQ(coh.renderFrame(), sw.renderFrame());
}

TEST(Coh, DelaysWhatWasHiddenInTheLastFrame) {
  FiveNodes tree;
  tree.setMu(2, 0.0);
  ScriptedRun run(tree, "coh-b", 0);
  run.renderFrame();
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 2 delay, query 2, result 2 hidden"));
  EXPECT_EQ(run.count(Counter::kDelays), 1);
  EXPECT_EQ(run.count(Counter::kD), 0) << "a delay that is culled is no delayed drawing";
  tree.setMu(2, 1.0);
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 2 delay, query 2, result 2 stop, draw 2"));
  EXPECT_EQ(run.count(Counter::kD), 1);
}

TEST(Coh, StopsWhereItStoppedAndWouldAgain) {
  FiveNodes tree;
  tree.setMu(1, 0.2);
  ScriptedRun run(tree, "coh-b", kNever);
  run.renderFrame();
  EXPECT_EQ(run.renderFrame(),
            "visit 0 refine, visit 1 stop, query 1, draw 1, visit 2 stop, query 2, draw 2, "
            "result 1 stop, result 2 stop");
}

TEST(Coh, RefinesWhereItStoppedWhenTheEstimateRises) {
  FiveNodes tree;
  tree.setMu(1, 0.2);
  ScriptedRun run(tree, "coh-b", kNever);
  run.renderFrame();
  run.zoom(2.5);  // 0.16 * 10 > 1
  EXPECT_EQ(
      run.renderFrame(),
      "visit 0 refine, visit 1 refine, visit 2 stop, query 2, draw 2, visit 4 delay, query 4, "
      "visit 3 delay, query 3, result 2 stop, result 4 stop, draw 4, result 3 stop, draw 3");
}

TEST(Coh, RefinesAgainAfterRenderingWhenAStopWasWrong) {
  FiveNodes tree;
  tree.setMu(1, 0.2);
  ScriptedRun run(tree, "coh-b", 0);
  run.renderFrame();
  tree.setMu(1, 1.0);
  EXPECT_EQ(run.renderFrame(),
            "visit 0 refine, visit 1 stop, query 1, draw 1, result 1 refine, rarn 1, "
            "visit 2 stop, query 2, draw 2, result 2 stop, "
            "visit 4 delay, query 4, result 4 stop, draw 4, "
            "visit 3 delay, query 3, result 3 stop, draw 3");
  EXPECT_EQ(run.count(Counter::kRarn), 1);
  EXPECT_EQ(run.count(Counter::kDn), 4) << "the parent counts as drawn, too";
}

TEST(Coh, DrawsAWrongStopThatIsHiddenOnceAndDelaysItNext) {
  FiveNodes tree;
  ScriptedRun run(tree, "coh-b", 0);
  run.renderFrame();
  tree.setMu(2, 0.0);
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 2 stop, query 2, draw 2, result 2 hidden"));
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 2 delay, query 2, result 2 hidden"));
}

// Node 1 was refined and stays so, or is a candidate for pulling up the front.
TEST(Coh, RefinesWhileAChildDidNotStop) {
  FiveNodes tree;
  tree.addChildren(3, 2);
  tree.setSse(3, 2.0);
  ScriptedRun run(tree, "coh-b", 0);
  run.renderFrame();
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 1 refine, "));
}

TEST(Coh, RefinesWhileAChildWouldNotStopAgain) {
  FiveNodes tree;
  tree.addChildren(3, 2);
  tree.setSse(1, 3.0);
  tree.setSse(3, 2.0);
  tree.setMu(3, 0.3);  // B = 0.347: 0.69
  tree.setMu(4, 0.01);
  ScriptedRun run(tree, "coh-b", 0);
  run.renderFrame();
  EXPECT_THAT(run.listDrawn(), ElementsAre(2, 4, 3));
  // 0.347 * 3.2 is above 1; the average (0.347 + 0.0004) / 2 * 4.8 would have said otherwise
  run.zoom(1.6);
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 1 refine"));
}

TEST(Coh, RefinesWhenTheAverageOfTheChildrenIsAboveTheThreshold) {
  FiveNodes tree;
  tree.setMu(3, 1.0);
  tree.setMu(4, 0.01);  // average 0.5002, times 4
  ScriptedRun run(tree, "coh-b", 0);
  run.renderFrame();
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 1 refine"));
}

TEST(Coh, DelaysACandidateForPullingUpTheFront) {
  FiveNodes tree;
  ScriptedRun run(tree, "coh-b", kNever);
  tree.setMu(3, 0.2);
  tree.setMu(4, 0.2);
  run.renderFrame();  // 1 itself is wholly visible and refined
  tree.setMu(1, 0.2);
  EXPECT_EQ(run.renderFrame(),
            "visit 0 refine, visit 1 delay, query 1, visit 2 stop, query 2, draw 2, "
            "result 1 stop, draw 1, result 2 stop");
  EXPECT_EQ(run.count(Counter::kD), 1);
  EXPECT_EQ(run.count(Counter::kDelays), 1);
}

TEST(Coh, PullsVisibilityUpToTheRoot) {
  FiveNodes tree;
  tree.setMu(2, 0.0);
  ScriptedRun run(tree, "coh-b", 0);
  run.renderFrame();
  // 0 and 1 get no query in this frame; only the leaves below 1 say that they are visible
  run.renderFrame();
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 0 refine, visit 1 refine"));
}

TEST(Coh, DelaysANodeNoneOfWhoseChildrenWasSeen) {
  FiveNodes tree;
  ScriptedRun run(tree, "coh-b", 0);
  run.renderFrame();
  tree.setMu(3, 0.0);
  tree.setMu(4, 0.0);
  run.renderFrame();
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 1 delay"));
}

TEST(Coh, TakesNoOpinionFromAChildThatWasOutsideTheFrustum) {
  for (const StaleChildren rule : {StaleChildren::kSkip, StaleChildren::kLiteral}) {
    // 3 leaves the frustum to the left with its bias of 1 cached; 4 stays with a low one
    FiveNodes tree;
    TraversalOptions options;
    options.staleChildren = rule;
    ScriptedRun run(tree, "coh-b", 0, options);
    run.renderFrame();
    tree.hierarchy.nodes[3].box = {{-200, -1, -14}, {-190, 1, -10}};
    tree.setMu(4, 0.2);
    EXPECT_THAT(run.renderFrame(), HasSubstr("visit 3 outside"));
    // skipped: average 0.16, times 4; literal: (1 + 0.16) / 2, times 4
    EXPECT_THAT(run.renderFrame(),
                HasSubstr(rule == StaleChildren::kSkip ? "visit 1 delay" : "visit 1 refine"));
  }
}

TEST(Coh, AHiddenChildPullsTheAverageDownUnlessReadLiterally) {
  for (const ZeroPixels rule : {ZeroPixels::kZeroBias, ZeroPixels::kLiteral}) {
    FiveNodes tree;
    tree.setSse(1, 1.9);
    TraversalOptions options;
    options.zeroPixels = rule;
    ScriptedRun run(tree, "coh-b", 0, options);
    run.renderFrame();
    tree.setMu(3, 0.0);
    run.renderFrame();
    // (0 + 1) / 2 * 1.9 is within tolerance, (1 + 1) / 2 * 1.9 is not
    EXPECT_THAT(run.renderFrame(),
                HasSubstr(rule == ZeroPixels::kZeroBias ? "visit 1 delay" : "visit 1 refine"));
  }
}

TEST(EveryStrategy, TakesABoxCutByTheNearPlaneAsVisibleWithoutAQuery) {
  for (const StrategyInfo& info : listStrategies()) {
    FiveNodes tree;
    tree.hierarchy.nodes[0].box.max.z = 1.0f;
    ScriptedRun run(tree, std::string(info.name), 0);
    const std::string frame = run.renderFrame();
    EXPECT_THAT(frame, testing::Not(HasSubstr("query 0"))) << info.name;
    if (asksQueries(run) && !info.needsRecording && !isWholePlugin(info)) {  // that predict
      EXPECT_THAT(frame, testing::StartsWith("visit 0 delay, near 0, visit 1")) << info.name;
    }
    run.renderFrame();
    EXPECT_THAT(run.listDrawn(), ElementsAre(2, 4, 3)) << info.name;
  }
}

TEST(EveryStrategy, VisitsEqualDistancesInTheOrderOfTheNodes) {
  for (const StrategyInfo& info : listStrategies()) {
    TinyTree tree;
    tree.addChildren(0, 2);
    tree.setSse(0, 8.0);
    ScriptedRun run(tree, std::string(info.name), 0);
    run.renderFrame();
    EXPECT_THAT(run.listDrawn(), ElementsAre(1, 2)) << info.name;
  }
}

TEST(Registry, NamesTheKnownStrategiesForAnUnknownOne) {
  try {
    findStrategy("chc");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("bool, sw-b, simp-b, coh-b, oracle, ideal, none, full"));
    EXPECT_THAT(error.what(), HasSubstr("'chc'"));
  }
}

}  // namespace
}  // namespace hlodbench
