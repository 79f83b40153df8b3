// A recorded front drawn again is the picture that the strategy showed; the other shadings cover
// the same pixels.
#include "front.h"
#include "gl_fixture.h"
#include "gl_replay.h"
#include "metrics/image_compare.h"
#include "overlay.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

class Pictures : public GlTest {
 protected:
  static Image redraw(Renderer& renderer, const Camera& camera, const Front& front,
                      Shading shading) {
    renderer.beginFrame(camera, shading);
    for (const DrawnNode& drawn : front.nodes) {
      renderer.setTint({1.0f, 0.0f, 0.0f});
      renderer.drawNode(drawn.node);
    }
    return renderer.readColor();
  }

  static bool coverSame(const Image& a, const Image& b) {
    for (std::size_t i = 0; i < a.pixelCount(); ++i)
      if (a.isCovered(i) != b.isCovered(i)) return false;
    return true;
  }
};

TEST_F(Pictures, AreWhatTheStrategyShowed) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session session = makeWalk(12, 160, 120);
  Rig rig(courtyard, session);
  for (const StrategyInfo& info : listStrategies()) {
    std::vector<Image> shown;
    std::vector<Front> fronts;
    ReplayHooks hooks;
    hooks.onFrame = [&](int) { shown.push_back(rig.renderer.readColor()); };
    hooks.onTrace = [&](TracedFrame&& f) {
      fronts.push_back(computeFront(f.record.frame, f.events));
    };
    const auto records = rig.replay(std::string(info.name), "draws:4", hooks);
    ASSERT_EQ(fronts.size(), records.size());
    for (std::size_t i = 0; i < fronts.size(); ++i) {
      EXPECT_EQ(fronts[i].nodes.size(), records[i].get(Counter::kDn));
      const Camera camera = makeCamera(session.lens, session.poses[i]);
      const Image lit = redraw(rig.renderer, camera, fronts[i], Shading::kLit);
      ASSERT_EQ(lit.pixels, shown[i].pixels) << info.name << ", frame " << i;
      const Image objects = redraw(rig.renderer, camera, fronts[i], Shading::kObjects);
      const Image tinted = redraw(rig.renderer, camera, fronts[i], Shading::kTinted);
      ASSERT_GT(countCovered(lit), 1000);
      EXPECT_TRUE(coverSame(lit, objects));
      EXPECT_TRUE(coverSame(lit, tinted));
    }
  }
}

TEST_F(Pictures, TracesOnlyTheFramesAskedFor) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session session = makeWalk(12, 64, 48);
  Rig rig(courtyard, session);
  std::vector<int> traced;
  ReplayHooks hooks;
  hooks.isTraced = [](int frame) { return frame == 3 || frame == 8; };
  hooks.onTrace = [&](TracedFrame&& f) { traced.push_back(f.record.frame); };
  rig.replay("coh-b", "draws:4", hooks);
  EXPECT_EQ(traced, (std::vector<int>{3, 8}));
}

TEST_F(Pictures, OfObjectsHoldTheirIndices) {
  FlatHierarchy flat;
  flat.addBox({{-3.0f, -1.0f, -1.0f}, {-1.0f, 1.0f, 1.0f}}, {255, 255, 255, 255}, 7);
  flat.addBox({{1.0f, -1.0f, -1.0f}, {3.0f, 1.0f, 1.0f}}, {255, 255, 255, 255}, 0x1203);
  Renderer renderer(flat.hierarchy, 160, 120);
  const Camera camera = makeCamera(makeLens(160, 120), lookAt({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}));
  renderer.beginFrame(camera, Shading::kObjects);
  renderer.drawNode(0);
  renderer.drawNode(1);
  const Image image = renderer.readColor();
  std::map<int, int> pixels;
  for (std::size_t i = 0; i < image.pixelCount(); ++i)
    if (image.isCovered(i)) ++pixels[image.pixels[4 * i] + 256 * image.pixels[4 * i + 1]];
  ASSERT_EQ(pixels.size(), 2u);
  EXPECT_GT(pixels[7], 300);
  EXPECT_GT(pixels[0x1203], 300);
  // and the lit picture that follows is not touched by it
  renderer.beginFrame(camera);
  renderer.drawNode(0);
  EXPECT_GT(countCovered(renderer.readColor()), 300);
}

}  // namespace
}  // namespace hlodbench
