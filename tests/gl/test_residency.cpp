// A GPU with too little memory for all nodes: what is drawn meanwhile, and what it becomes.
#include <chrono>
#include <set>
#include <thread>

#include "../unit/mesh_helpers.h"
#include "gl_fixture.h"
#include "gl_replay.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

class ResidencyTest : public GlTest {
 protected:
  static std::uint64_t sumBytes(const Hierarchy& h, const std::vector<NodeId>& nodes) {
    std::uint64_t bytes = h.node(kRoot).blockBytes();
    for (const NodeId id : nodes)
      if (id != kRoot) bytes += h.node(id).blockBytes();
    return bytes;
  }
  static std::uint64_t allBytes(const Hierarchy& h) { return h.geometry.bytes().size(); }
  static Image drawEach(Renderer& renderer, const Camera& camera,
                        const std::vector<NodeId>& nodes) {
    renderer.beginFrame(camera);
    for (const NodeId id : nodes) renderer.drawNode(id);
    return renderer.readColor();
  }
  // A front, refined at random, of what is in view.
  static std::vector<NodeId> makeFront(const Hierarchy& h, const Camera& camera, unsigned refine,
                                       std::mt19937& random) {
    const Frustum frustum(camera);
    std::vector<NodeId> front, open{kRoot};
    while (!open.empty()) {
      const NodeId id = open.back();
      open.pop_back();
      const Node& node = h.node(id);
      if (!frustum.intersects(node.box)) continue;
      if (node.isLeaf() || random() % 100 >= refine)
        front.push_back(id);
      else
        for (std::uint32_t i = 0; i < node.childCount; ++i) open.push_back(node.firstChild + i);
    }
    return front;
  }
  static void waitALittle() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }
};

TEST_F(ResidencyTest, WhoStandsStillSeesInTheEndWhatABudgetWithoutLimitShows) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session walk = makeWalk(6, kWidth, kHeight);
  std::mt19937 random(1);
  Renderer full(courtyard, kWidth, kHeight);
  EXPECT_FALSE(full.isLimited());
  for (const std::uint64_t spare : {0u, 50'000u}) {
    for (const unsigned refine : {80u, 95u, 100u}) {
      const Camera camera = makeCamera(walk.lens, walk.poses[random() % 6]);
      const std::vector<NodeId> front = makeFront(courtyard, camera, refine, random);
      const std::vector<NodeId> before = makeFront(courtyard, camera, 90, random);
      // not a byte more than the front takes
      const std::uint64_t budget =
          std::max(computeLeastBudget(courtyard), sumBytes(courtyard, front)) + spare;
      ASSERT_LT(budget, allBytes(courtyard));
      Renderer renderer(courtyard, kWidth, kHeight, {.gpuMemory = budget});
      ASSERT_TRUE(renderer.isLimited());
      // what another view left behind is in the way, in pieces
      for (int i = 0; i < 20; ++i) {
        drawEach(renderer, camera, before);
        waitALittle();
      }
      int frames = 0;
      do {
        drawEach(renderer, camera, front);
        EXPECT_LE(renderer.residency().residentBytes, budget);
        waitALittle();
      } while (renderer.residency().missingNodes > 0 && ++frames < 2000);
      EXPECT_EQ(renderer.residency().missingNodes, 0u) << "refined by " << refine;
      EXPECT_EQ(drawEach(renderer, camera, front).pixels, drawEach(full, camera, front).pixels);
      drawEach(renderer, camera, front);
      EXPECT_EQ(renderer.residency().loads, 0u);
      EXPECT_EQ(renderer.residency().evictions, 0u);
    }
  }
}

TEST_F(ResidencyTest, ABudgetForEverythingIsNoLimit) {
  const Hierarchy courtyard = buildSmallCourtyard();
  Renderer renderer(courtyard, kWidth, kHeight, {.gpuMemory = allBytes(courtyard)});
  EXPECT_FALSE(renderer.isLimited());
  EXPECT_EQ(renderer.residency().residentBytes, allBytes(courtyard));
  EXPECT_EQ(renderer.residency().missingNodes, 0u);
}

TEST_F(ResidencyTest, EveryNodeIsDrawnOrAnAncestorOfItOnce) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session walk = makeWalk(6, kWidth, kHeight);
  const std::uint64_t least = computeLeastBudget(courtyard);
  for (const std::uint64_t budget : {least, least * 2, least * 8, allBytes(courtyard) / 2}) {
    Residency residency(courtyard, budget);
    std::mt19937 random(2);
    std::uint64_t loads = 0;
    for (int frame = 0; frame < 60; ++frame) {
      const Camera camera = makeCamera(walk.lens, walk.poses[frame / 10]);
      residency.beginFrame();
      loads += residency.counters().loads;
      EXPECT_LE(residency.counters().residentBytes, budget);
      std::set<NodeId> drawn;
      std::uint64_t missing = 0;
      for (const NodeId id : makeFront(courtyard, camera, 93, random)) {
        const NodeId chosen = residency.choose(id);
        if (chosen != kNoNode) {
          EXPECT_TRUE(drawn.insert(chosen).second);
          // what is drawn lies within the budget
          EXPECT_LE(residency.place(chosen).offset + courtyard.node(chosen).blockBytes(), budget);
        }
        bool found = drawn.contains(id);
        missing += found ? 0 : 1;
        for (NodeId at = courtyard.node(id).parent; !found && at != kNoNode;
             at = courtyard.node(at).parent)
          found = drawn.contains(at);
        EXPECT_TRUE(found) << "node " << id;
      }
      EXPECT_EQ(residency.counters().missingNodes, missing);
      waitALittle();
    }
    EXPECT_GT(loads, 0u);
  }
}

TEST_F(ResidencyTest, NoHoleOpensInAClosedRoom) {
  TriangleMesh mesh;
  addBumpySphere(mesh, 200, glm::vec3(0.0f), 6.0f, 0);
  const Hierarchy room = buildTestHierarchy(mesh, 300);
  std::mt19937 random(3);
  Lens lens = makeLens(kWidth, kHeight);
  lens.nearPlane = 0.02;
  std::uint64_t missing = 0;
  for (const std::uint64_t budget : {computeLeastBudget(room), allBytes(room) / 8}) {
    Renderer renderer(room, kWidth, kHeight, {.gpuMemory = budget});
    for (int frame = 0; frame < 80; ++frame) {
      const double angle = 0.2 * frame;
      const Camera camera = makeCamera(
          lens, lookAt({0.0, 0.0, 0.0}, {std::cos(angle), 0.3 * std::sin(angle), std::sin(angle)}));
      const Image image = drawEach(renderer, camera, makeFront(room, camera, 92, random));
      EXPECT_EQ(countCovered(image), kWidth * kHeight) << "frame " << frame;
      missing += renderer.residency().missingNodes;
    }
  }
  EXPECT_GT(missing, 100u);
}

TEST_F(ResidencyTest, PicturesWaitForEveryNode) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session walk = makeWalk(6, kWidth, kHeight);
  std::mt19937 random(4);
  Renderer full(courtyard, kWidth, kHeight);
  Renderer least(courtyard, kWidth, kHeight, {.gpuMemory = computeLeastBudget(courtyard)});
  Renderer some(courtyard, kWidth, kHeight, {.gpuMemory = allBytes(courtyard) / 4});
  for (const Pose& pose : walk.poses) {
    const Camera camera = makeCamera(walk.lens, pose);
    const std::vector<NodeId> front = makeFront(courtyard, camera, 90, random);
    const Image expected = drawEach(full, camera, front);
    for (Renderer* renderer : {&least, &some}) {
      renderer->beginFrame(camera);
      renderer->drawNodes(front);
      EXPECT_EQ(renderer->readColor().pixels, expected.pixels);
    }
    // and frames between them do no harm
    drawEach(some, camera, makeFront(courtyard, camera, 95, random));
    waitALittle();
  }
}

TEST_F(ResidencyTest, TooSmallABudgetIsRefusedWithTheLeastThatWorks) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const std::uint64_t least = computeLeastBudget(courtyard);
  try {
    Renderer renderer(courtyard, kWidth, kHeight, {.gpuMemory = least - 1});
    FAIL();
  } catch (const InputError& error) {
    const std::string words = "expected at least " + std::to_string((least + 1023) / 1024) + "K";
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
  EXPECT_NO_THROW(Renderer(courtyard, kWidth, kHeight, {.gpuMemory = least}));
}

TEST_F(ResidencyTest, ADamagedBlockIsFoundWhenItIsWanted) {
  Hierarchy courtyard = buildSmallCourtyard();
  const auto last = static_cast<NodeId>(courtyard.nodes.size() - 1);
  ++courtyard.nodes[last].geometryHash;
  Renderer renderer(courtyard, kWidth, kHeight, {.gpuMemory = allBytes(courtyard) / 2});
  const Camera camera = makeCamera(makeLens(kWidth, kHeight), Pose{});
  drawEach(renderer, camera, {last - 1});
  const auto wantIt = [&] {
    for (int i = 0; i < 2000; ++i) {
      drawEach(renderer, camera, {last});
      waitALittle();
    }
  };
  EXPECT_THROW(wantIt(), InputError);
  EXPECT_THROW(renderer.drawNodes(std::vector{last}), InputError);
}

// A session under a budget, with every strategy: it ends, and says how it went.
TEST_F(ResidencyTest, StrategiesReplayUnderABudget) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session walk = makeWalk(20, kWidth, kHeight);
  const std::uint64_t budget = computeLeastBudget(courtyard) * 4;
  for (const StrategyInfo& info : listStrategies()) {
    Rig rig(courtyard, walk, {.gpuMemory = budget});
    const auto records = rig.replay(std::string(info.name), "draws:4");
    EXPECT_GT(sum(records, Counter::kMissingNodes), 0.0) << info.name;
    EXPECT_GT(sum(records, Counter::kLoads), 0.0) << info.name;
    for (const FrameRecord& record : records)
      EXPECT_LE(record.get(Counter::kResidentMib) * (1 << 20), static_cast<double>(budget));
  }
}

}  // namespace
}  // namespace hlodbench
