#pragma once

#include <atomic>

namespace hlodbench {

// Where a run is. Lies in memory that the run shares with the process that watches it.
struct Heartbeat {
  enum class Stage : int {
    kOther,    // nothing of a plug-in runs; may take any time
    kLoading,  // plug-ins are opened
    kReplay,   // a strategy runs
    kLeaving   // done; only the program's end is left
  };

  static constexpr int kMaking = -1, kRemoving = -2;  // for `frame`: of the strategy

  std::atomic<Stage> stage{Stage::kOther};
  std::atomic<int> index{-1};  // in kReplay: of the planned replay; in kLoading: of the plug-in
  std::atomic<int> frame{kMaking};  // in kReplay: which has begun
  std::atomic<int> exitCode{2};     // in kLeaving

  void enter(Stage next, int nextIndex = -1) {
    index = nextIndex;
    frame = kMaking;
    stage = next;
  }
};

// At its end, however it comes, only the end of the program is left.
class Leaving {
 public:
  explicit Leaving(Heartbeat& heartbeat) : heartbeat_(heartbeat) {}
  ~Leaving() { heartbeat_.enter(Heartbeat::Stage::kLeaving); }
  Leaving(const Leaving&) = delete;
  Leaving& operator=(const Leaving&) = delete;

 private:
  Heartbeat& heartbeat_;
};

static_assert(std::atomic<int>::is_always_lock_free &&
              std::atomic<Heartbeat::Stage>::is_always_lock_free);

}  // namespace hlodbench
