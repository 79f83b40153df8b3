// The limits that strategies are compared with, on random trees with scripted queries.
#include <gmock/gmock.h>

#include <set>
#include <stdexcept>

#include "explain_pass.h"
#include "front.h"
#include "random_tree.h"

namespace hlodbench {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAreArray;

// Calls check(run, tree) after each of some frames of a strategy, while visibility changes and the
// camera turns.
template <typename Check>
void forFrames(const std::string& strategy, Check check) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    TinyTree tree = makeRandomTree(random);
    ScriptedRun run(tree, strategy, random() % 6);
    for (int frame = 0; frame < 10; ++frame) {
      shakeVisibility(tree, random);
      run.camera = makeTurnedCamera(0.02 * static_cast<double>(random() % 40));
      run.renderFrame();
      check(run, tree);
    }
  }
}

int countDrawnAbove(const TinyTree& tree, const std::set<NodeId>& drawn, NodeId id) {
  int count = 0;
  for (; id != kNoNode; id = tree.hierarchy.node(id).parent) count += drawn.contains(id) ? 1 : 0;
  return count;
}

TEST(Oracle, DrawsTheFrontOfStopAndWaitAndNothingElse) {
  int changes = 0;
  forFrames("oracle", [&](const ScriptedRun& run, const TinyTree&) {
    const RecordedFrame& recorded = run.recording.frames.back();
    ASSERT_EQ(run.listDrawn(), recorded.drawn);
    ASSERT_EQ(run.trace.size(), recorded.drawn.size()) << "something besides drawing";
    for (const Counter same : {Counter::kDn, Counter::kTriangles, Counter::kFrontChange}) {
      ASSERT_EQ(run.record.has(same), recorded.record.has(same));
      if (!run.record.has(same)) continue;
      ASSERT_EQ(run.record.get(same), recorded.record.get(same));
    }
    for (const Counter none : {Counter::kQueries, Counter::kRarn, Counter::kD, Counter::kDelays,
                               Counter::kNodesVisited, Counter::kQueriesWasted})
      ASSERT_FALSE(run.record.has(none));
    changes += run.count(Counter::kFrontChange);
  });
  EXPECT_GT(changes, 1000);
}

// Notes how the front comes.
class CountingServices final : public FrameServices {
 public:
  void draw(NodeId node) override { drawn.push_back(node); }
  void drawAll(std::span<const NodeId> nodes) override {
    ++calls;
    drawn.assign(nodes.begin(), nodes.end());
  }
  void issueQuery(NodeId) override { ADD_FAILURE() << "a query"; }
  bool isAvailable(NodeId) override { return false; }
  std::uint32_t getResult(NodeId) override { return 0; }

  std::vector<NodeId> drawn;
  int calls = 0;
};

TEST(Oracle, GivesTheFrontAtOnceAndEndsWithItsRecording) {
  const TinyTree tree;
  FrontRecording recording;
  recording.frames.push_back({{2, 7, 5}, {}, {}, {}});
  const auto oracle = findStrategy("oracle").make({tree.hierarchy, {}, &recording});
  CountingServices services;
  FrameRecord record;
  oracle->renderFrame(makeTestCamera(), services, record, nullptr);
  EXPECT_EQ(services.calls, 1);
  EXPECT_THAT(services.drawn, ElementsAre(2, 7, 5));
  EXPECT_THROW(oracle->renderFrame(makeTestCamera(), services, record, nullptr), std::out_of_range);
}

TEST(Ideal, DrawsTheFrontOfStopAndWaitAndPredictsNothingWrong) {
  int hidden = 0;
  forFrames("ideal", [&](const ScriptedRun& run, const TinyTree& tree) {
    const RecordedFrame& recorded = run.recording.frames.back();
    ASSERT_EQ(run.listDrawn(), recorded.drawn);
    ASSERT_EQ(run.count(Counter::kRarn), 0);
    ASSERT_EQ(run.count(Counter::kD), 0);
    ASSERT_EQ(run.count(Counter::kRepeatedDelays), 0);
    const auto predictions = collectDecisions(0, run.trace).predictions;
    ASSERT_EQ(judgePredictions(tree.hierarchy, predictions, recorded).right,
              static_cast<int>(predictions.size()));
    ASSERT_EQ(run.count(Counter::kDelays), static_cast<int>(recorded.hidden.size()));
    hidden += run.count(Counter::kDelays);
  });
  EXPECT_GT(hidden, 100);
}

TEST(None, DrawsTheCoarsestCutWithinToleranceOfAllInTheFrustum) {
  int outside = 0;
  forFrames("none", [&](const ScriptedRun& run, const TinyTree& tree) {
    const std::vector<NodeId> list = run.listDrawn();
    const std::set<NodeId> drawn(list.begin(), list.end());
    ASSERT_EQ(drawn.size(), list.size());
    const auto isTolerable = [&](NodeId id) {
      const Node& node = tree.hierarchy.node(id);
      return node.isLeaf() || computeScreenError(run.camera, node.box, node.error) <= 1.0;
    };
    for (const NodeId id : drawn) {
      ASSERT_TRUE(isTolerable(id)) << id;
      ASSERT_TRUE(id == kRoot || !isTolerable(tree.hierarchy.node(id).parent)) << id;
    }
    const std::vector<NodeId> inside = listLeavesInside(tree.hierarchy, Frustum(run.camera));
    for (const NodeId leaf : inside) ASSERT_EQ(countDrawnAbove(tree, drawn, leaf), 1) << leaf;
    for (NodeId id = 0; id < tree.hierarchy.nodes.size(); ++id)
      outside += tree.hierarchy.node(id).isLeaf() ? 1 : 0;
    outside -= static_cast<int>(inside.size());
    ASSERT_FALSE(run.record.has(Counter::kQueries));
    ASSERT_FALSE(run.record.has(Counter::kRarn));
    ASSERT_EQ(run.count(Counter::kDn), static_cast<int>(drawn.size()));
  });
  EXPECT_GT(outside, 1000) << "all was in the frustum: nothing was tested";
}

TEST(Full, DrawsEveryLeafInTheFrustumNearestFirst) {
  forFrames("full", [&](const ScriptedRun& run, const TinyTree& tree) {
    const std::vector<NodeId> drawn = run.listDrawn();
    ASSERT_THAT(drawn,
                UnorderedElementsAreArray(listLeavesInside(tree.hierarchy, Frustum(run.camera))));
    const auto distance = [&](NodeId id) {
      return computeDistance(run.camera, tree.hierarchy.node(id).box);
    };
    // but for rounding, as a box may lie nearer by a bit than the one around it
    for (std::size_t i = 1; i < drawn.size(); ++i)
      ASSERT_LE(distance(drawn[i - 1]), distance(drawn[i]) * (1.0 + 1e-9));
    ASSERT_FALSE(run.record.has(Counter::kQueries));
  });
}

TEST(Registry, SaysWhichStrategiesNeedARecording) {
  const TinyTree tree;
  for (const StrategyInfo& info : listStrategies()) {
    EXPECT_EQ(info.needsRecording, info.name == "oracle" || info.name == "ideal") << info.name;
    if (info.needsRecording) {
      EXPECT_THROW(info.make({tree.hierarchy}), std::invalid_argument) << info.name;
    } else {
      EXPECT_NO_THROW(info.make({tree.hierarchy})) << info.name;
    }
  }
}

TEST(FrontRecording, TellsWhatBecameOfEachNode) {
  TinyTree tree;  // root 0 over 1 and 2; 1 over 3 and 4; the root is near
  tree.addChildren(0, 2);
  tree.addChildren(1, 2);
  tree.setSse(0, 8.0);
  tree.setSse(1, 4.0);
  tree.hierarchy.nodes[0].box.max.z = 1.0f;
  tree.setMu(3, 0.0);
  ScriptedRun run(tree, "sw-b", 0);
  run.renderFrame();
  const RecordedFrame& frame = run.recording.frames.at(0);
  EXPECT_THAT(frame.refined, ElementsAre(0, 1));
  EXPECT_THAT(frame.drawn, ElementsAre(2, 4));
  EXPECT_THAT(frame.hidden, ElementsAre(3));
  EXPECT_EQ(frame.record.get(Counter::kDn), 2);
}

TEST(FrontRecording, RefusesAFrameOfAnotherStrategy) {
  EXPECT_THROW(makeRecordedFrame({{TraceEvent::Type::kRarn, 0}}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace hlodbench
