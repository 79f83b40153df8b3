#include "hlod/render/frame_pacer.h"

namespace hlodbench {

FramePacer::~FramePacer() {
  for (GLsync fence : fences_) glDeleteSync(fence);
}

void FramePacer::endFrame() {
  fences_.push_back(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
  glFlush();
  while (fences_.size() > static_cast<std::size_t>(framesInFlight_)) {
    constexpr GLuint64 kSecond = 1'000'000'000;
    GLenum status = GL_TIMEOUT_EXPIRED;
    while (status == GL_TIMEOUT_EXPIRED)
      status = glClientWaitSync(fences_.front(), GL_SYNC_FLUSH_COMMANDS_BIT, kSecond);
    glDeleteSync(fences_.front());
    fences_.pop_front();
  }
}

}  // namespace hlodbench
