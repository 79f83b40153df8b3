// The limits on a real scene and real queries, and what of a front is seen.
#include <cmath>
#include <map>

#include "explain_pass.h"
#include "gl_fixture.h"
#include "gl_replay.h"
#include "visible_parts.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

constexpr int kWidth = 160;
constexpr int kHeight = 120;

class Limits : public GlTest {
 protected:
  // A replay with its pictures.
  struct Shown {
    std::vector<FrameRecord> records;
    std::vector<Image> images;
  };
  static Shown show(Rig& rig, const std::string& strategy, const std::string& latency) {
    Shown shown;
    ReplayHooks hooks;
    hooks.onFrame = [&](int) { shown.images.push_back(rig.renderer.readColor()); };
    shown.records = rig.replay(strategy, latency, hooks);
    return shown;
  }
};

TEST_F(Limits, ThatKnowTheFrontShowWhatStopAndWaitShows) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session session = makeWalk(24, kWidth, kHeight);
  Rig rig(courtyard, session);
  const Shown sw = show(rig, "sw-b", "draws:4");
  double drawn = 0.0;
  // a prediction that is right needs no result: the latency has no influence
  for (const auto& [strategy, latency] : std::map<std::string, std::string>{
           {"oracle", "draws:4"}, {"ideal", "draws:4"}, {"ideal ", "gl"}}) {
    const Shown limit = show(rig, strategy.substr(0, strategy.find(' ')), latency);
    ASSERT_EQ(limit.records.size(), sw.records.size());
    for (std::size_t i = 0; i < sw.records.size(); ++i) {
      for (const Counter same : {Counter::kDn, Counter::kTriangles})
        ASSERT_EQ(limit.records[i].get(same), sw.records[i].get(same)) << strategy << ' ' << i;
      ASSERT_EQ(limit.images[i].pixels, sw.images[i].pixels) << strategy << ", frame " << i;
      ASSERT_TRUE(strategy == "oracle" || limit.records[i].get(Counter::kRarn) == 0.0);
      drawn += limit.records[i].get(Counter::kDn);
    }
  }
  EXPECT_GT(drawn, 1000.0);
}

TEST_F(Limits, UnderABudgetTakeWhatIsThere) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session session = makeWalk(12, kWidth, kHeight);
  Rig rig(courtyard, session, {.gpuMemory = computeLeastBudget(courtyard) * 4});
  const auto records = rig.replay("oracle", "draws:4");
  // waiting for nodes, as pictures do, would leave none missing
  EXPECT_GT(sum(records, Counter::kMissingNodes), 0.0);
}

// A square that faces the camera, `size` half its side.
NodeId addSquare(FlatHierarchy& flat, float x, float y, float z, float size) {
  return flat.add({{x - size, y - size, z},
                   {x + size, y - size, z},
                   {x + size, y + size, z},
                   {x - size, y + size, z}},
                  {{0, 1, 2}, {0, 2, 3}});
}

class SeenParts : public GlTest {
 protected:
  static VisibleParts count(const FlatHierarchy& flat, const std::vector<NodeId>& nodes) {
    Renderer renderer(flat.hierarchy, kWidth, kHeight);
    const Camera camera =
        makeCamera(makeLens(kWidth, kHeight), lookAt({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}));
    return countVisibleParts(flat.hierarchy, renderer, camera, nodes).value();
  }
};

TEST_F(SeenParts, LeaveOutWhatIsHiddenOrOutside) {
  FlatHierarchy flat;
  const NodeId left = addSquare(flat, -2.0f, 0.0f, 0.0f, 1.0f);
  const NodeId right = addSquare(flat, 2.0f, 0.0f, 0.0f, 1.0f);
  const NodeId behindLeft = addSquare(flat, -2.0f, 0.0f, -1.0f, 0.5f);
  const NodeId outside = addSquare(flat, 100.0f, 0.0f, 0.0f, 1.0f);
  VisibleParts parts = count(flat, {behindLeft, left, right, outside});
  EXPECT_EQ(parts.nodes, 2u);
  EXPECT_EQ(parts.triangles, 4u);
  parts = count(flat, {behindLeft, right});
  EXPECT_EQ(parts.nodes, 2u);
  EXPECT_EQ(parts.triangles, 4u);
  parts = count(flat, {outside});
  EXPECT_EQ(parts.nodes, 0u);
  EXPECT_EQ(parts.triangles, 0u);
}

TEST_F(SeenParts, GiveAPixelToTheNodeDrawnLastInTheSamePlace) {
  FlatHierarchy flat;
  const NodeId small = addSquare(flat, 0.0f, 0.0f, 0.0f, 0.5f);
  const NodeId large = addSquare(flat, 0.0f, 0.0f, 0.0f, 1.0f);
  EXPECT_EQ(count(flat, {small, large}).nodes, 1u);
  EXPECT_EQ(count(flat, {large, small}).nodes, 2u);
}

TEST_F(SeenParts, TellMoreNodesApartThanAByte) {
  FlatHierarchy flat;
  std::vector<NodeId> nodes;
  for (int i = 0; i < 600; ++i)
    nodes.push_back(addSquare(flat, 0.2f * static_cast<float>(i % 30) - 3.0f,
                              0.2f * static_cast<float>(i / 30) - 2.0f, 0.0f, 0.09f));
  const VisibleParts parts = count(flat, nodes);
  EXPECT_EQ(parts.nodes, 600u);
  EXPECT_GT(parts.triangles, 600u);
  EXPECT_LE(parts.triangles, 1200u);
}

TEST_F(SeenParts, TellMoreTrianglesApartThanTwoBytes) {
  // a grid that fills the view, each triangle of a few pixels
  constexpr int kSide = 190;
  const Lens lens = makeLens(640, 480);
  const double halfHeight = 10.0 * std::tan(0.5 * lens.fovyRad);
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x) {
      const glm::dvec2 at = glm::dvec2(x, y) * 2.0 / double{kSide} - 1.0;
      positions.emplace_back(at.x * halfHeight * 640.0 / 480.0, at.y * halfHeight, 0.0);
      if (x == kSide || y == kSide) continue;
      const unsigned corner = y * (kSide + 1) + x;
      triangles.emplace_back(corner, corner + 1, corner + kSide + 1);
      triangles.emplace_back(corner + 1, corner + kSide + 2, corner + kSide + 1);
    }
  FlatHierarchy flat;
  const std::vector<NodeId> nodes{flat.add(positions, triangles)};
  Renderer renderer(flat.hierarchy, lens.width, lens.height);
  const Camera camera = makeCamera(lens, lookAt({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}));
  const auto parts = countVisibleParts(flat.hierarchy, renderer, camera, nodes);
  ASSERT_TRUE(parts.has_value());
  EXPECT_GT(parts->triangles, 65536u);
  EXPECT_LE(parts->triangles, triangles.size());
}

TEST_F(SeenParts, AreThoseWithoutWhichThePictureDiffers) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session session = makeWalk(3, 80, 60);
  Rig rig(courtyard, session);
  const FrontRecording recording = rig.record();
  std::vector<FrameDecisions> decisions;
  ReplayHooks hooks;
  hooks.onTrace = [&](TracedFrame&& f) {
    decisions.push_back(collectDecisions(f.record.frame, f.events));
  };
  std::vector<FrameRecord> records = rig.replay("bool", "draws:4", hooks);
  ASSERT_TRUE(explainFrames(
      courtyard, rig.renderer, session, recording, decisions, [] { return false; }, {}, records));
  const auto draw = [&](const FrameDecisions& frame, NodeId without) {
    rig.renderer.beginFrame(makeCamera(session.lens, session.poses[frame.frame]), Shading::kFlat);
    for (const NodeId node : frame.drawn) {
      rig.renderer.setTint(glm::vec3(node & 255u, node >> 8, 0.0f) / 255.0f);
      if (node != without) rig.renderer.drawNode(node);
    }
    return rig.renderer.readColor().pixels;
  };
  double invisible = 0.0;
  for (const FrameDecisions& frame : decisions) {
    const FrameRecord& record = records[frame.frame];
    const auto all = draw(frame, kNoNode);
    int unseen = 0;
    for (const NodeId node : frame.drawn) unseen += draw(frame, node) == all ? 1 : 0;
    EXPECT_EQ(record.get(Counter::kInvisibleNodes), unseen) << frame.frame;
    EXPECT_GT(record.get(Counter::kVisibleTriangles), record.get(Counter::kDn) - unseen - 1.0);
    EXPECT_GE(record.get(Counter::kInvisibleTriangles), 0.0);
    EXPECT_EQ(record.get(Counter::kVisibleTriangles) + record.get(Counter::kInvisibleTriangles),
              record.get(Counter::kTriangles));
    invisible += unseen;
  }
  EXPECT_GT(invisible, 0.0) << "all was seen: nothing was tested";
}

}  // namespace
}  // namespace hlodbench
