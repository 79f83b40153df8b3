// Geometry in several buffers: nothing that is drawn or counted tells how many there are.
#include "gl_fixture.h"
#include "gl_replay.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

constexpr int kWidth = 160;
constexpr int kHeight = 120;
// A page for each block, and pages of several blocks.
constexpr std::uint64_t kPageSizes[] = {1, std::uint64_t{64} << 10};

class Pages : public GlTest {
 protected:
  static void expectEqual(const Renderer& a, const Renderer& b) {
    const Image color = a.readColor();
    EXPECT_GT(countCovered(color), 0);
    EXPECT_EQ(b.readColor().pixels, color.pixels);
    EXPECT_EQ(b.readDepth().depth, a.readDepth().depth);
  }
  // Leaves in an order in which neighbours are rarely in one page.
  static std::vector<NodeId> shuffleLeaves(const Hierarchy& h, std::mt19937& random) {
    std::vector<NodeId> leaves;
    for (NodeId id = 0; id < h.nodes.size(); ++id)
      if (h.node(id).isLeaf()) leaves.push_back(id);
    std::shuffle(leaves.begin(), leaves.end(), random);
    return leaves;
  }
};

TEST_F(Pages, ShowThePictureAndTheDepthOfOne) {
  Hierarchy courtyard = buildSmallCourtyard();
  std::mt19937 random(1);
  for (Node& node : courtyard.nodes) node.flags = random() % 2;
  const Session walk = makeWalk(4, kWidth, kHeight);
  const RendererOptions culled{.culling = FaceCulling::kBackWhereConsistent};
  Renderer one(courtyard, kWidth, kHeight, culled);
  for (const std::uint64_t most : kPageSizes) {
    RendererOptions options = culled;
    options.mostPageBytes = most;
    Renderer many(courtyard, kWidth, kHeight, options);
    for (const Pose& pose : walk.poses) {
      const Camera camera = makeCamera(walk.lens, pose);
      const std::vector<NodeId> leaves = shuffleLeaves(courtyard, random);
      const std::span<const NodeId> all(leaves);
      for (Renderer* renderer : {&one, &many}) {
        renderer->beginFrame(camera);
        for (const NodeId id : all) {
          renderer->drawNode(id);
          if (id % 5 == 0) renderer->drawBox(id);
        }
      }
      expectEqual(one, many);
      one.beginFrame(camera, Shading::kObjects);
      for (const NodeId id : all) one.drawNode(id);
      many.beginFrame(camera, Shading::kObjects);
      many.drawNodes(all.first(all.size() / 3));
      many.drawBox(leaves[0]);
      many.drawNodes(all.subspan(all.size() / 3));
      expectEqual(one, many);
    }
  }
}

TEST_F(Pages, AreAsManyAsTheirSizeAsksFor) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const std::uint64_t all = courtyard.geometry.bytes().size();
  EXPECT_EQ(Residency(courtyard, kUnlimitedMemory).pages().size(), 1u);
  EXPECT_EQ(Residency(courtyard, kUnlimitedMemory, 1).pages().size(), courtyard.nodes.size());
  const Residency some(courtyard, kUnlimitedMemory, all / 8);
  EXPECT_GE(some.pages().size(), 8u);
  EXPECT_LE(some.pages().size(), 10u);
  EXPECT_EQ(some.counters().residentBytes, all);
}

TEST_F(Pages, DoNotChangeWhatIsCounted) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session walk = makeWalk(12, kWidth, kHeight);
  Rig one(courtyard, walk);
  Rig many(courtyard, walk, {.mostPageBytes = kPageSizes[1]});
  for (const StrategyInfo& info : listStrategies())
    EXPECT_EQ(exactCounts(many.replay(std::string(info.name), "draws:4")),
              exactCounts(one.replay(std::string(info.name), "draws:4")))
        << info.name;
}

TEST_F(Pages, ABudgetThatIsTooSmallForEverythingIsOne) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session walk = makeWalk(4, kWidth, kHeight);
  const std::uint64_t budget = courtyard.geometry.bytes().size() - 1;
  const std::uint64_t most = computeLeastBudget(courtyard) * 3;
  Renderer full(courtyard, kWidth, kHeight);
  Renderer capped(courtyard, kWidth, kHeight, {.gpuMemory = budget, .mostPageBytes = most});
  ASSERT_TRUE(capped.isLimited());
  std::mt19937 random(2);
  for (const Pose& pose : walk.poses) {
    const Camera camera = makeCamera(walk.lens, pose);
    const std::vector<NodeId> leaves = shuffleLeaves(courtyard, random);
    for (Renderer* renderer : {&full, &capped}) {
      renderer->beginFrame(camera);
      renderer->drawNodes(leaves);
    }
    expectEqual(full, capped);
    capped.beginFrame(camera);  // counts what the last frame left
    EXPECT_LE(capped.residency().residentBytes, most);
  }
  // every node must be able to come
  EXPECT_NO_THROW(Renderer(courtyard, kWidth, kHeight, {.gpuMemory = budget, .mostPageBytes = 1}));
}

}  // namespace
}  // namespace hlodbench
