// A frame takes no memory once everything that it needs has been taken: neither renderer nor
// traversal nor the replay loop. Counted are the allocations of C++ code in the drawing thread.
#include <cstdlib>
#include <new>

#include "gl_fixture.h"
#include "gl_replay.h"

namespace {

thread_local bool isCounting = false;
thread_local std::size_t allocations = 0;

void* allocate(std::size_t size) {
  if (isCounting) ++allocations;
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size);
}
void* operator new[](std::size_t size) {
  return allocate(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

constexpr int kFrames = 90;

class Allocations : public GlTest, public ::testing::WithParamInterface<std::string> {
 protected:
  // In the last third of a walk that is made three times.
  static std::size_t count(Rig& rig) {
    std::size_t counted = 0;
    ReplayHooks hooks;
    hooks.onFrame = [&](int frame) {
      if (frame + 1 == 2 * kFrames / 3) {
        allocations = 0;
        isCounting = true;
      } else if (frame + 1 == kFrames) {
        isCounting = false;
        counted = allocations;
      }
    };
    rig.replay(GetParam(), "draws:4", hooks);
    return counted;
  }
  static Session makeWalks() {
    Session session = makeWalk(kFrames / 3, 64, 48);
    const std::vector<Pose> once = session.poses;
    for (int i = 0; i < 2; ++i) session.poses.insert(session.poses.end(), once.begin(), once.end());
    return session;
  }
};

TEST_P(Allocations, AreNoneInAFrameWithAllNodes) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session session = makeWalks();
  Rig rig(courtyard, session);
  EXPECT_EQ(count(rig), 0u);
}

TEST_P(Allocations, AreNoneInAFrameUnderABudget) {
  const Hierarchy courtyard = buildSmallCourtyard();
  const Session session = makeWalks();
  Rig rig(courtyard, session, {.gpuMemory = computeLeastBudget(courtyard) * 8});
  EXPECT_EQ(count(rig), 0u);
  EXPECT_TRUE(rig.renderer.isLimited());
}

INSTANTIATE_TEST_SUITE_P(All, Allocations, ::testing::Values("bool", "sw-b", "simp-b", "coh-b"),
                         [](const auto& test) {
                           return test.param.substr(0, test.param.find('-'));
                         });

}  // namespace
}  // namespace hlodbench
