// What explains a strategy's costs, worked out again from its traces.
#include <gmock/gmock.h>

#include <map>
#include <set>
#include <stdexcept>

#include "explain_pass.h"
#include "random_tree.h"

namespace hlodbench {
namespace {

using Type = TraceEvent::Type;

// One frame of a strategy as its trace tells it.
struct ToldFrame {
  std::map<NodeId, Prediction> predictions;
  std::set<NodeId> drawn, refinedAfterDrawing, visible, decidedVisible;
  std::map<NodeId, bool> confirmed;  // by node queried: visible, and to be drawn

  ToldFrame() = default;
  ToldFrame(const TinyTree& tree, const Trace& trace) {
    for (const TraceEvent& e : trace) {
      if (e.type == Type::kVisit && e.inFrustum) predictions[e.node] = e.prediction;
      if (e.type == Type::kDraw) drawn.insert(e.node);
      if (e.type == Type::kRarn) refinedAfterDrawing.insert(e.node);
      if (e.type == Type::kResult) confirmed[e.node] = e.pixels > 0 && e.stop;
      if (e.type == Type::kNear || (e.type == Type::kResult && e.pixels > 0)) {
        decidedVisible.insert(e.node);
        for (NodeId id = e.node; id != kNoNode; id = tree.hierarchy.node(id).parent)
          visible.insert(id);
      }
    }
  }
  [[nodiscard]] bool endedAt(NodeId id) const {
    return drawn.contains(id) && !refinedAfterDrawing.contains(id);
  }
};

class Explained : public testing::TestWithParam<std::string> {
 protected:
  // Calls check(run, tree, this frame, the last one) for frames that have a last one.
  template <typename Check>
  static void forFrames(Check check) {
    std::mt19937 random(9);
    for (int round = 0; round < 20; ++round) {
      TinyTree tree = makeRandomTree(random);
      ScriptedRun run(tree, GetParam(), random() % 6);
      ToldFrame last;
      for (int frame = 0; frame < 12; ++frame) {
        shakeVisibility(tree, random);
        run.camera = makeTurnedCamera(0.02 * static_cast<double>(random() % 40));
        run.renderFrame();
        const ToldFrame told(tree, run.trace);
        if (frame > 0) check(run, tree, told, last);
        ASSERT_EQ(run.record.has(Counter::kFrontChange), frame > 0);
        last = told;
      }
    }
  }
};

TEST_P(Explained, TheChangeOfTheFrontIsWhatIsInOneFrameOnly) {
  int total = 0;
  forFrames(
      [&](const ScriptedRun& run, const TinyTree&, const ToldFrame& now, const ToldFrame& last) {
        std::vector<NodeId> change;
        std::set_symmetric_difference(now.drawn.begin(), now.drawn.end(), last.drawn.begin(),
                                      last.drawn.end(), std::back_inserter(change));
        ASSERT_TRUE(run.record.has(Counter::kFrontChange));
        ASSERT_EQ(run.count(Counter::kFrontChange), static_cast<int>(change.size()));
        total += static_cast<int>(change.size());
      });
  EXPECT_GT(total, 100);
}

// Of strategies that predict node by node.
class ExplainedPredictions : public Explained {};

TEST_P(ExplainedPredictions, AQueryIsWastedThatConfirmsAStop) {
  int total = 0;
  bool asks = false;
  forFrames([&](const ScriptedRun& run, const TinyTree&, const ToldFrame& now, const ToldFrame&) {
    int wasted = 0;
    for (const auto& [node, confirmed] : now.confirmed)
      if (confirmed && now.predictions.at(node) == Prediction::kStop) ++wasted;
    asks = run.record.has(Counter::kQueries);
    ASSERT_EQ(run.record.has(Counter::kQueriesWasted), asks);
    ASSERT_EQ(run.count(Counter::kQueriesWasted), wasted);
    total += wasted;
  });
  EXPECT_EQ(total > 0, asks && GetParam() != "sw-b");
}

TEST_P(ExplainedPredictions, ADelayIsRepeatedWhoseNodeIsSeenAndDecidedAsInTheLastFrame) {
  int total = 0;
  forFrames(
      [&](const ScriptedRun& run, const TinyTree&, const ToldFrame& now, const ToldFrame& last) {
        int repeated = 0;
        for (const auto& [node, prediction] : now.predictions)
          if (prediction == Prediction::kDelay && now.decidedVisible.contains(node) &&
              last.predictions.contains(node) && last.visible.contains(node) &&
              now.endedAt(node) == last.endedAt(node))
            ++repeated;
        ASSERT_EQ(run.count(Counter::kRepeatedDelays), repeated);
        ASSERT_LE(repeated, run.count(Counter::kDelays));
        total += repeated;
      });
  if (GetParam() == "sw-b" || GetParam() == "coh-b") {
    EXPECT_GT(total, 20);
  }
}

TEST_P(ExplainedPredictions, EveryPredictionIsOneOfTheFour) {
  PredictionCounts total;
  forFrames([&](const ScriptedRun& run, const TinyTree& tree, const ToldFrame& now,
                const ToldFrame&) {
    const PredictionCounts counts = judgePredictions(
        tree.hierarchy, collectDecisions(0, run.trace).predictions, run.recording.frames.back());
    ASSERT_EQ(counts.right + counts.tooConservative + counts.tooAggressive + counts.needlessDelays,
              static_cast<int>(now.predictions.size()));
    // a wrong Stop is found out, as queries pass the same pixels for both here
    if (run.record.has(Counter::kRarn)) {
      ASSERT_LE(counts.tooAggressive, run.count(Counter::kRarn));
    }
    total.right += counts.right;
    total.tooConservative += counts.tooConservative;
    total.tooAggressive += counts.tooAggressive;
    total.needlessDelays += counts.needlessDelays;
  });
  if (GetParam() == "coh-b" || GetParam() == "simp-b") {
    EXPECT_GT(total.right, 100);
    EXPECT_GT(total.tooConservative, 10);
    EXPECT_GT(total.tooAggressive, 10);
    EXPECT_GT(total.needlessDelays, 10);
  }
  if (GetParam() == "bool") {
    EXPECT_EQ(total.tooAggressive, 0) << "it stops by SSE, which VMSSE does not exceed";
  }
  if (GetParam() == "sw-b") {
    EXPECT_EQ(total.tooAggressive + total.tooConservative, 0);
    EXPECT_GT(total.needlessDelays, total.right) << "it waits for all that it draws";
  }
}

INSTANTIATE_TEST_SUITE_P(All, Explained, testing::ValuesIn(listStrategyNames()),
                         [](const auto& test) { return nameTest(test.param); });
INSTANTIATE_TEST_SUITE_P(All, ExplainedPredictions, testing::ValuesIn(listPredictingNames()),
                         [](const auto& test) { return nameTest(test.param); });

// Root 0, refined, over 1, refined, 2, drawn, and 3, hidden; each of these has two children. Of
// those of 1, 4 is drawn and 5 hidden.
struct JudgedTree : TinyTree {
  JudgedTree() {
    addChildren(0, 3);
    for (NodeId id : {1u, 2u, 3u}) addChildren(id, 2);
    truth.refined = {0, 1};
    truth.drawn = {2, 4};
    truth.hidden = {3, 5};
  }
  PredictionCounts judge(NodeId node, Prediction prediction) const {
    return judgePredictions(hierarchy, {{node, prediction}}, truth);
  }
  RecordedFrame truth;
};

TEST(Judge, ComparesWithWhereStopAndWaitEnded) {
  constexpr PredictionCounts kRight{1, 0, 0, 0};
  constexpr PredictionCounts kConservative{0, 1, 0, 0};
  constexpr PredictionCounts kAggressive{0, 0, 1, 0};
  constexpr PredictionCounts kNeedless{0, 0, 0, 1};
  struct Row {
    NodeId node;
    PredictionCounts refine, stop, delay;
  };
  const JudgedTree tree;
  for (const Row& row : {
           Row{1, kRight, kAggressive, kNeedless},        // refined
           Row{2, kConservative, kRight, kNeedless},      // drawn
           Row{3, kConservative, kConservative, kRight},  // hidden
           Row{6, kConservative, kRight, kRight},         // below what was drawn
           Row{8, kConservative, kConservative, kRight}   // below what was hidden
       }) {
    EXPECT_EQ(tree.judge(row.node, Prediction::kRefine), row.refine) << row.node;
    EXPECT_EQ(tree.judge(row.node, Prediction::kStop), row.stop) << row.node;
    EXPECT_EQ(tree.judge(row.node, Prediction::kDelay), row.delay) << row.node;
  }
}

TEST(Judge, RefusesATruthThatDoesNotFit) {
  JudgedTree tree;
  tree.truth.hidden.clear();
  EXPECT_THROW(tree.judge(5, Prediction::kStop), std::invalid_argument);
  EXPECT_THROW(tree.judge(8, Prediction::kStop), std::invalid_argument);
}

TEST(Decisions, AreThePredictionsInTheFrustumAndWhatIsDrawn) {
  const Trace trace{
      {.type = Type::kVisit, .node = 1, .inFrustum = true, .prediction = Prediction::kStop},
      {.type = Type::kQuery, .node = 1},
      {.type = Type::kDraw, .node = 1},
      {.type = Type::kVisit, .node = 2}};
  const FrameDecisions decisions = collectDecisions(7, trace);
  EXPECT_EQ(decisions.frame, 7);
  ASSERT_EQ(decisions.predictions.size(), 1u);
  EXPECT_EQ(decisions.predictions[0].node, 1u);
  EXPECT_EQ(decisions.predictions[0].prediction, Prediction::kStop);
  EXPECT_THAT(decisions.drawn, testing::ElementsAre(1));
}

}  // namespace
}  // namespace hlodbench
