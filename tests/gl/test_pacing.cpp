// Frames in flight and GPU time. The context ends the program on every GL error.
#include "gl_fixture.h"
#include "gl_replay.h"
#include "hlod/render/frame_pacer.h"
#include "hlod/render/gpu_timer.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

class PacingTest : public GlTest {
 protected:
  static constexpr int kFrames = 20;
};

TEST_F(PacingTest, ReplaysWithAnyNumberOfFramesInFlightCountTheSame) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session session = makeWalk(kFrames, 160, 120);
  Rig rig(courtyard, session);
  const GpuTimer timer;
  std::vector<double> counts;
  for (const int framesInFlight : {0, 1, 3}) {
    const auto records = rig.replay("coh-b", "draws:8", {}, {}, framesInFlight);
    ASSERT_EQ(records.size(), static_cast<std::size_t>(kFrames));
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    if (counts.empty()) counts = exactCounts(records);
    EXPECT_EQ(exactCounts(records), counts) << framesInFlight << " frames in flight";
    for (const FrameRecord& record : records) {
      EXPECT_GT(record.get(Counter::kFrameMs), 0.0);
      EXPECT_GE(record.get(Counter::kWaitMs), 0.0);
      ASSERT_EQ(record.has(Counter::kGpuMs), timer.exists()) << "frame " << record.frame;
      if (!timer.exists()) continue;
      EXPECT_GT(record.get(Counter::kGpuMs), 0.0) << "frame " << record.frame;
      EXPECT_LT(record.get(Counter::kGpuMs), 60e3) << "frame " << record.frame;
    }
  }
}

TEST_F(PacingTest, APacerOfNoFramesInFlightLeavesNothingUnfinished) {
  FlatHierarchy flat;
  const NodeId box = flat.addBox({{-1, -1, -6}, {1, 1, -5}});
  Renderer renderer(flat.hierarchy, 160, 120);
  const Camera camera = makeCamera(makeLens(160, 120), Pose{});
  FramePacer pacer(0);
  for (int frame = 0; frame < kFrames; ++frame) {
    renderer.beginFrame(camera);
    renderer.drawNode(box);
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    pacer.endFrame();
    // a wait of no time at all finds the frame finished
    const GLenum status = glClientWaitSync(fence, 0, 0);
    EXPECT_TRUE(status == GL_ALREADY_SIGNALED || status == GL_CONDITION_SATISFIED) << status;
    glDeleteSync(fence);
  }
}

TEST_F(PacingTest, TheTimerReadsEveryFrameOnceTwoFramesLateAndTheRestWhenDrained) {
  FlatHierarchy flat;
  const NodeId box = flat.addBox({{-1, -1, -6}, {1, 1, -5}});
  Renderer renderer(flat.hierarchy, 160, 120);
  const Camera camera = makeCamera(makeLens(160, 120), Pose{});
  GpuTimer timer;
  if (!timer.exists()) GTEST_SKIP() << "THIS DRIVER'S TIMESTAMPS HAVE NO BITS";
  std::vector<int> read;
  for (int frame = 0; frame < kFrames; ++frame) {
    timer.beginFrame(frame);
    renderer.beginFrame(camera);
    renderer.drawNode(box);
    timer.endFrame();
    const auto reading = timer.read();
    ASSERT_EQ(reading.has_value(), frame >= 2) << "frame " << frame;
    if (!reading) continue;
    EXPECT_EQ(reading->frame, frame - 2);
    EXPECT_GT(reading->milliseconds, 0.0);
    read.push_back(reading->frame);
  }
  while (const auto reading = timer.read(true)) read.push_back(reading->frame);
  ASSERT_EQ(read.size(), static_cast<std::size_t>(kFrames));
  for (int frame = 0; frame < kFrames; ++frame) EXPECT_EQ(read[frame], frame);
}

}  // namespace
}  // namespace hlodbench
