// Occlusion queries: what they count, and that their results do not depend on when they are read.
#include <map>

#include "gl_fixture.h"
#include "gl_replay.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

class QueryTest : public GlTest {
 protected:
  static constexpr int kSize = 200;
  const Camera camera_ = makeCamera(makeLens(kSize, kSize), Pose{});
};

TEST_F(QueryTest, CountAHiddenBoxAsNothingAndAHalfHiddenOneAsHalf) {
  FlatHierarchy flat;
  const NodeId wall = flat.addBox({{-3, -3, -5}, {0, 3, -4.9f}});
  const NodeId hidden = flat.addBox({{-2, -1, -9}, {-1, 1, -8}});
  const NodeId half = flat.addBox({{-1, -1, -8.1f}, {1, 1, -8}});
  const NodeId open = flat.addBox({{1, -1, -9}, {2, 1, -8}});
  const NodeId front = flat.addBox({{-2, -1, -4}, {-1, 1, -3}});
  Renderer renderer(flat.hierarchy, kSize, kSize);
  GlQuerySource queries(renderer, flat.hierarchy.nodes.size());
  queries.beginFrame();
  renderer.beginFrame(camera_);
  renderer.drawNode(wall);
  for (const NodeId id : {hidden, half, open, front}) queries.issue(id);
  const auto share = [&](NodeId id) {
    return queries.getResult(id) / computeProjectedArea(camera_, flat.hierarchy.node(id).box);
  };
  EXPECT_EQ(queries.getResult(hidden), 0u);
  EXPECT_NEAR(share(half), 0.5, 0.03);
  EXPECT_NEAR(share(open), 1.0, 0.06);
  EXPECT_NEAR(share(front), 1.0, 0.06);
}

TEST_F(QueryTest, OfBothFacesCountAPixelTwice) {
  FlatHierarchy flat;
  const NodeId open = flat.addBox({{1, -1, -9}, {2, 1, -8}});
  const auto count = [&](QueryFaces faces) {
    Renderer renderer(flat.hierarchy, kSize, kSize, {.queryFaces = faces});
    GlQuerySource queries(renderer, flat.hierarchy.nodes.size());
    queries.beginFrame();
    renderer.beginFrame(camera_);
    queries.issue(open);
    return queries.getResult(open);
  };
  EXPECT_GT(count(QueryFaces::kFront), 0u);
  EXPECT_EQ(count(QueryFaces::kBoth), 2 * count(QueryFaces::kFront));
}

TEST_F(QueryTest, CountABoxThatTheNearPlaneCutsOnlyWithoutClipping) {
  FlatHierarchy flat;
  // beside the eye and reaching behind it, and one whose front lies before the near plane
  const std::vector<NodeId> cut{flat.addBox({{0.3f, -0.5f, -4}, {2, 0.5f, 1}}),
                                flat.addBox({{-0.05f, -0.5f, -3}, {1, 0.5f, -0.01f}})};
  const auto share = [&](NodeId node, bool clips) {
    Renderer renderer(flat.hierarchy, kSize, kSize, {.clipsBoxes = clips});
    GlQuerySource queries(renderer, flat.hierarchy.nodes.size());
    queries.beginFrame();
    renderer.beginFrame(camera_);
    queries.issue(node);
    const Aabb& box = flat.hierarchy.node(node).box;
    return queries.getResult(node) / computeProjectedAreaOfCutBox(camera_, box);
  };
  for (const NodeId node : cut) {
    ASSERT_TRUE(isCutByNearPlane(camera_, flat.hierarchy.node(node).box));
    EXPECT_NEAR(share(node, false), 1.0, 0.03);
  }
  EXPECT_LT(share(cut[1], true), 0.5) << "else the clamp would not be needed";
}

TEST_F(QueryTest, SeeOnlyWhatWasDrawnBeforeThem) {
  FlatHierarchy flat;
  const NodeId wall = flat.addBox({{-3, -3, -5}, {3, 3, -4.9f}});
  const NodeId before = flat.addBox({{-1, -1, -9}, {1, 1, -8}});
  const NodeId after = flat.addBox({{-1, -1, -9}, {1, 1, -8}});
  Renderer renderer(flat.hierarchy, kSize, kSize);
  GlQuerySource queries(renderer, flat.hierarchy.nodes.size());
  queries.beginFrame();
  renderer.beginFrame(camera_);
  queries.issue(before);
  renderer.drawNode(wall);
  queries.issue(after);
  EXPECT_GT(queries.getResult(before), 0u);
  EXPECT_EQ(queries.getResult(after), 0u);
}

TEST_F(QueryTest, AreReusedFromFrameToFrameAndBecomeAvailableByThemselves) {
  std::mt19937 random(6);
  FlatHierarchy flat;
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  for (int i = 0; i < 50; ++i) {
    const glm::vec3 centre(3 * uniform(random), 3 * uniform(random), -8 + 3 * uniform(random));
    flat.addBox({centre - 0.4f, centre + 0.4f + 0.3f * uniform(random)});
  }
  Renderer renderer(flat.hierarchy, kSize, kSize);
  GlQuerySource queries(renderer, flat.hierarchy.nodes.size());
  std::map<NodeId, std::uint32_t> expected;
  for (int frame = 0; frame < 100; ++frame) {
    queries.beginFrame();
    renderer.beginFrame(camera_);
    // not all of them and not in the same order: a node's query is another object each time
    std::vector<NodeId> asked;
    for (int i = 0; i < 20; ++i) {
      const NodeId id = random() % 50;
      if (!canBeQueried(camera_, flat.hierarchy.node(id).box) ||
          std::find(asked.begin(), asked.end(), id) != asked.end())
        continue;
      queries.issue(id);
      asked.push_back(id);
    }
    glFlush();
    for (const NodeId id : asked) {
      if (frame % 2 == 0) {
        while (!queries.isAvailable(id)) {
        }
      }
      const std::uint32_t pixels = queries.getResult(id);
      EXPECT_TRUE(queries.isAvailable(id));
      const auto [place, isNew] = expected.emplace(id, pixels);
      ASSERT_EQ(place->second, pixels) << "node " << id << " in frame " << frame;
    }
  }
  EXPECT_GT(expected.size(), 40u);
  // objects are named from the lowest free name on: thousands of queries took no more than 20
  const GlQuery next;
  EXPECT_LT(next, 100u);
}

TEST_F(QueryTest, KeepTheirResultsUntilTheNodeIsAskedAgain) {
  FlatHierarchy flat;
  const NodeId wall = flat.addBox({{-3, -3, -5}, {0, 3, -4.9f}});
  const NodeId half = flat.addBox({{-1, -1, -8.1f}, {1, 1, -8}});
  const NodeId other = flat.addBox({{1, -1, -9}, {2, 1, -8}});
  Renderer renderer(flat.hierarchy, kSize, kSize);
  GlQuerySource queries(renderer, flat.hierarchy.nodes.size());
  const auto ask = [&](NodeId id, bool behindWall) {
    queries.beginFrame();
    renderer.beginFrame(camera_);
    if (behindWall) renderer.drawNode(wall);
    queries.issue(id);
    return id;
  };
  const std::uint32_t open = queries.getResult(ask(half, false));
  ask(half, true);
  for (int frame = 0; frame < 5; ++frame) queries.getResult(ask(other, false));
  const std::uint32_t hidden = queries.getResult(half);  // five frames later
  EXPECT_NEAR(static_cast<double>(hidden) / open, 0.5, 0.05);
  EXPECT_EQ(queries.getResult(half), hidden);
  // a result that nobody read is replaced by that of the next query
  ask(half, true);
  EXPECT_EQ(queries.getResult(ask(half, false)), open);
}

TEST_F(QueryTest, WaitedForGiveStopAndWaitTheSameCountsAtAnyLatency) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session session = makeWalk(8, 160, 120);
  Rig rig(courtyard, session);
  const std::vector<double> counts = exactCounts(rig.replay("sw-b", "gl"));
  for (const char* latency : {"draws:0", "draws:8", "frames:1"})
    EXPECT_EQ(exactCounts(rig.replay("sw-b", latency)), counts) << latency;
}

}  // namespace
}  // namespace hlodbench
