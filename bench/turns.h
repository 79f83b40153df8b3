#pragma once

#include <functional>

namespace hlodbench {

// Turns of two programs that replay the same session at the same time on the same machine: each
// draws some frames while the other waits. What slows the machine down for a while then meets both
// alike, frame for frame, however long it lasts.
//
// They share a pair of connected stream sockets, an end each. Whoever has a turn owns the one byte
// that goes to and fro. Whoever set up the pair puts it in, and so says who begins.
class Turns {
 public:
  // descriptor: the end, inherited from whoever started this program. frames: in a turn, from 1.
  // Throws InputError if it is no socket.
  Turns(int descriptor, int frames);

  [[nodiscard]] bool beginsWith(int frame) const { return frame % frames_ == 0; }
  [[nodiscard]] bool endsWith(int frame) const { return (frame + 1) % frames_ == 0; }
  // Waits for the turn. Returns also when the other program has ended, or when interrupted.
  void take(const std::function<bool()>& isInterrupted);
  void pass();

 private:
  int descriptor_;
  int frames_;
};

}  // namespace hlodbench
