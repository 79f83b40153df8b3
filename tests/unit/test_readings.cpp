// Each switch of a reading of the paper, in a case worked by hand where it changes the outcome.
#include <gmock/gmock.h>

#include "readings.h"
#include "tiny_tree.h"

namespace hlodbench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(PullUpReading, DecidesWhatAChildThatGoesOnSaysOfItsParent) {
  for (const PullUp reading : {PullUp::kRefine, PullUp::kDelay}) {
    FiveNodes tree;
    TraversalOptions options;
    options.pullUp = reading;
    ScriptedRun run(tree, "coh-b", 0, options);
    run.renderFrame();
    // 1 was refined, and is a child of 0 that does not stop
    const std::string frame = run.renderFrame();
    if (reading == PullUp::kRefine) {
      EXPECT_THAT(frame, testing::StartsWith("visit 0 refine, visit 1 refine"));
    } else {
      EXPECT_THAT(frame, testing::StartsWith("visit 0 delay, query 0, result 0 refine, "
                                             "visit 1 refine"));
    }
    EXPECT_EQ(run.count(Counter::kDn), 3);
    EXPECT_EQ(run.count(Counter::kDelays), reading == PullUp::kDelay ? 1 : 0);
  }
}

TEST(PullUpReading, StillRefinesAParentWhoseChildrenAllStopButForTheirAverage) {
  FiveNodes tree;
  TraversalOptions options;
  options.pullUp = PullUp::kDelay;
  ScriptedRun run(tree, "coh-b", 0, options);
  run.renderFrame();
  // both leaves below 1 stop; their average bias of 1 times 4 is above the threshold
  EXPECT_THAT(run.renderFrame(), HasSubstr("visit 1 refine"));
}

TEST(PullUpReading, MattersToCohAlone) {
  for (const std::string name : {"bool", "sw-b", "simp-b"}) {
    FiveNodes tree;
    TraversalOptions options;
    options.pullUp = PullUp::kDelay;
    ScriptedRun literal(tree, name, 0, options);
    ScriptedRun usual(tree, name, 0);
    for (int frame = 0; frame < 3; ++frame)
      EXPECT_EQ(literal.renderFrame(), usual.renderFrame()) << name;
  }
}

TEST(RenderGuardReading, OffDrawsAStopAgainWhenItsResultConfirmsIt) {
  FiveNodes tree;
  tree.setMu(1, 0.2);
  TraversalOptions options;
  options.renderGuard = RenderGuard::kOff;
  ScriptedRun run(tree, "coh-b", 0, options);
  run.renderFrame();
  EXPECT_EQ(run.count(Counter::kDn), 2) << "what waited for its result is drawn once";
  EXPECT_EQ(run.renderFrame(),
            "visit 0 refine, visit 1 stop, query 1, draw 1, result 1 stop, draw 1, "
            "visit 2 stop, query 2, draw 2, result 2 stop, draw 2");
  EXPECT_EQ(run.count(Counter::kDn), 4);
  EXPECT_EQ(run.count(Counter::kRarn), 0);
  tree.setMu(2, 0.0);
  run.renderFrame();
  EXPECT_THAT(run.listDrawn(), ElementsAre(1, 1, 2)) << "a Stop that is hidden is drawn once";
}

TEST(RenderGuardReading, OffCountsARefinementAfterRenderingOnce) {
  FiveNodes tree;
  tree.setMu(1, 0.2);
  TraversalOptions options;
  options.renderGuard = RenderGuard::kOff;
  ScriptedRun run(tree, "coh-b", 0, options);
  run.renderFrame();
  tree.setMu(1, 1.0);
  EXPECT_THAT(run.renderFrame(), HasSubstr("draw 1, result 1 refine, rarn 1"));
  EXPECT_EQ(run.count(Counter::kRarn), 1);
}

TEST(NearPlaneReading, QueriesACutBoxWhileTheEyeIsOutside) {
  for (const NearPlane reading : {NearPlane::kVisible, NearPlane::kQuery}) {
    FiveNodes tree;
    // 2 reaches behind the eye, beside it; the root around both holds the eye
    tree.hierarchy.nodes[2].box = {{1, -1, -10}, {2, 1, 1}};
    tree.hierarchy.nodes[0].box = {{-2, -1, -14}, {2, 1, 1}};
    tree.setMu(2, 0.0);
    TraversalOptions options;
    options.nearPlane = reading;
    ScriptedRun run(tree, "sw-b", 0, options);
    const std::string frame = run.renderFrame();
    EXPECT_THAT(frame, HasSubstr("visit 0 delay, near 0")) << "the eye is inside of it";
    EXPECT_THAT(frame,
                HasSubstr(reading == NearPlane::kQuery ? "visit 2 delay, query 2, result 2 hidden"
                                                       : "visit 2 delay, near 2, draw 2"));
  }
}

TEST(MuAreaReading, UnclippedTakesThePixelsOutsideOfTheViewportAsHidden) {
  for (const MuArea reading : {MuArea::kClipped, MuArea::kUnclipped}) {
    TinyTree tree;
    tree.addChildren(0, 2);
    // a third of the root's width is inside the viewport, which ends at x = 2/3 of the distance
    tree.hierarchy.nodes[0].box = {{5, -1, -12}, {14, 1, -12}};
    tree.setSse(0, 2.0);
    TraversalOptions options;
    options.muArea = reading;
    ScriptedRun run(tree, "sw-b", 0, options);
    const Aabb& box = tree.hierarchy.nodes[0].box;
    const double share =
        computeProjectedArea(run.camera, box) / computeUnclippedArea(run.camera, box);
    ASSERT_NEAR(share, 1.0 / 3.0, 0.01);
    const std::string frame = run.renderFrame();
    ASSERT_EQ(run.trace[2].type, TraceEvent::Type::kResult);
    // B(1) = 1 and B(1/3) = 0.41: twice that is within tolerance
    EXPECT_NEAR(run.trace[2].mu, reading == MuArea::kClipped ? 1.0 : share, 0.001);
    EXPECT_THAT(frame, HasSubstr(reading == MuArea::kClipped ? "result 0 refine"
                                                             : "result 0 stop, draw 0"));
  }
}

TEST(Readings, AreListedAsRunJsonStoresThem) {
  using List = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(listReadings({}, QueryFaces::kFront), (List{{"pull_up", "refine"},
                                                        {"render_guard", "on"},
                                                        {"near_plane", "visible"},
                                                        {"query_faces", "front"},
                                                        {"mu_area", "clipped"}}));
  TraversalOptions options;
  options.pullUp = PullUp::kDelay;
  options.renderGuard = RenderGuard::kOff;
  options.nearPlane = NearPlane::kQuery;
  options.muArea = MuArea::kUnclipped;
  EXPECT_EQ(listReadings(options, QueryFaces::kBoth), (List{{"pull_up", "delay"},
                                                            {"render_guard", "off"},
                                                            {"near_plane", "query"},
                                                            {"query_faces", "both"},
                                                            {"mu_area", "unclipped"}}));
}

}  // namespace
}  // namespace hlodbench
