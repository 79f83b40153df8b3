#pragma once

#include <array>
#include <optional>

#include "hlod/render/gl_object.h"

namespace hlodbench {

// Time between two GPU timestamps of a frame, read two frames late so that reading never waits.
class GpuTimer {
 public:
  GpuTimer();

  // False where the driver's timestamps have no bits; then nothing else does anything.
  [[nodiscard]] bool exists() const { return exists_; }
  void beginFrame(int frame);
  void endFrame();

  struct Reading {
    int frame;
    double milliseconds;
  };
  // The reading that is due: that of the frame two before; with `drain`, the next one at all.
  std::optional<Reading> read(bool drain = false);

 private:
  static constexpr int kLatency = 2;
  static constexpr int kSlots = kLatency + 1;
  struct Slot {
    GlQuery begin, end;
    int frame = -1;
    bool pending = false;
  };
  bool exists_;
  std::array<Slot, kSlots> slots_;
  int next_ = 0;  // slot of the coming frame
};

}  // namespace hlodbench
