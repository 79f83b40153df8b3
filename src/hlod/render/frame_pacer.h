#pragma once

#include <deque>

#include "hlod/render/gl_object.h"

namespace hlodbench {

// Lets the CPU run ahead of the GPU by a fixed number of frames, as a swap chain does.
class FramePacer {
 public:
  // framesInFlight: 0 waits for each frame to be finished before the next one is begun.
  explicit FramePacer(int framesInFlight) : framesInFlight_(framesInFlight) {}
  ~FramePacer();
  FramePacer(const FramePacer&) = delete;
  FramePacer& operator=(const FramePacer&) = delete;

  // To be called where a frame would be presented; waits until no more than framesInFlight frames
  // are unfinished.
  void endFrame();

 private:
  int framesInFlight_;
  std::deque<GLsync> fences_;
};

}  // namespace hlodbench
