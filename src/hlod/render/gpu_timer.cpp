#include "hlod/render/gpu_timer.h"

namespace hlodbench {

GpuTimer::GpuTimer() {
  GLint bits = 0;
  glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  exists_ = bits > 0;
}

void GpuTimer::beginFrame(int frame) {
  if (!exists_) return;
  slots_[next_].frame = frame;
  glQueryCounter(slots_[next_].begin, GL_TIMESTAMP);
}

void GpuTimer::endFrame() {
  if (!exists_) return;
  glQueryCounter(slots_[next_].end, GL_TIMESTAMP);
  slots_[next_].pending = true;
  next_ = (next_ + 1) % kSlots;
}

std::optional<GpuTimer::Reading> GpuTimer::read(bool drain) {
  // the slot to be written next holds the oldest frame
  for (int i = 0; i < (drain ? kSlots : 1); ++i) {
    Slot& slot = slots_[(next_ + i) % kSlots];
    if (!slot.pending) continue;
    GLuint64 begin = 0;
    GLuint64 end = 0;
    glGetQueryObjectui64v(slot.begin, GL_QUERY_RESULT, &begin);
    glGetQueryObjectui64v(slot.end, GL_QUERY_RESULT, &end);
    slot.pending = false;
    return Reading{slot.frame, static_cast<double>(end - begin) * 1e-6};
  }
  return std::nullopt;
}

}  // namespace hlodbench
