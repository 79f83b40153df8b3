#pragma once

#include <cstddef>
#include <vector>

#include "hlod/render/gl_object.h"

namespace hlodbench {

// Lets the CPU run ahead of the GPU by a fixed number of frames, as a swap chain does.
class FramePacer {
 public:
  // framesInFlight: 0 waits for each frame to be finished before the next one is begun.
  explicit FramePacer(int framesInFlight)
      : fences_(static_cast<std::size_t>(framesInFlight) + 1, nullptr) {}
  ~FramePacer();
  FramePacer(const FramePacer&) = delete;
  FramePacer& operator=(const FramePacer&) = delete;

  // To be called where a frame would be presented; waits until no more than framesInFlight frames
  // are unfinished.
  void endFrame();

 private:
  std::vector<GLsync> fences_;  // a ring of frames that may be unfinished; null where there is none
  std::size_t next_ = 0;        // the oldest one's place
};

}  // namespace hlodbench
