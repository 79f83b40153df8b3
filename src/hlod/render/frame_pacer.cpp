#include "hlod/render/frame_pacer.h"

namespace hlodbench {

FramePacer::~FramePacer() {
  for (GLsync fence : fences_) glDeleteSync(fence);  // null is ignored
}

void FramePacer::endFrame() {
  fences_[next_] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
  next_ = (next_ + 1) % fences_.size();
  GLsync& oldest = fences_[next_];
  if (oldest == nullptr) return;
  constexpr GLuint64 kSecond = 1'000'000'000;
  GLenum status = GL_TIMEOUT_EXPIRED;
  while (status == GL_TIMEOUT_EXPIRED)
    status = glClientWaitSync(oldest, GL_SYNC_FLUSH_COMMANDS_BIT, kSecond);
  glDeleteSync(oldest);
  oldest = nullptr;
}

}  // namespace hlodbench
