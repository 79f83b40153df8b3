// A replay of 10,000 frames takes no more memory than one of a few hundred.
#include <malloc.h>

#include <fstream>

#include "gl_fixture.h"
#include "gl_replay.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

class LongReplay : public GlTest {};

// Resident memory of this process, KiB.
long readResidentKib() {
  ::malloc_trim(0);
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmRSS:") {
      long kib = 0;
      status >> kib;
      return kib;
    }
  return -1;
}

TEST_F(LongReplay, TakesNoMoreMemoryAfterTenThousandFrames) {
  constexpr int kFrames = 10'000;
  constexpr int kWarm = 1000;
  const Hierarchy courtyard = buildSmallCourtyard();
  Session session = makeWalk(500, 32, 24);
  const std::vector<Pose> once = session.poses;
  while (session.poses.size() < kFrames)
    session.poses.insert(session.poses.end(), once.begin(), once.end());
  Rig rig(courtyard, session);
  long warm = 0;
  long last = 0;
  ReplayHooks hooks;
  hooks.onFrame = [&](int frame) {
    if (frame == kWarm) warm = readResidentKib();
    if (frame == kFrames - 1) last = readResidentKib();
  };
  rig.replay("coh-b", "gl", hooks);
  ASSERT_GT(warm, 0);
  // the log itself, 160 bytes a frame, is reserved at the start but touched as it fills
  constexpr long kLogKib = (kFrames - kWarm) * long{sizeof(FrameRecord)} / 1024;
  // the driver's pools settle late; half a KiB a frame would be over it
  constexpr long kDriverKib = 4096;
  EXPECT_LE(last - warm, kLogKib + kDriverKib) << "KiB more than after " << kWarm << " frames";
}

}  // namespace
}  // namespace hlodbench
