#pragma once

#include <cstddef>
#include <string>

#include "session.h"

namespace hlodbench {

// Shows a session frame by frame.
class SessionPlayer {
 public:
  // Stands at the first frame. timeStep: seconds from one frame to the next, > 0, where the session
  // does not say.
  void load(Session session, double timeStep = 1.0 / 60.0);
  void clear() { *this = SessionPlayer(); }
  [[nodiscard]] bool empty() const { return session_.poses.empty(); }

  // These are for one that is not empty.
  [[nodiscard]] const Session& session() const { return session_; }
  [[nodiscard]] double timeStep() const { return timeStep_; }  // seconds
  [[nodiscard]] std::size_t frame() const { return frame_; }
  [[nodiscard]] const Pose& pose() const { return session_.poses[frame_]; }
  // Both stop playing. What lies outside is taken to the first or the last frame.
  void seek(std::size_t frame);
  void step(long frames);
  // Begins at the first frame again when it stands at the last.
  void play(bool on);
  [[nodiscard]] bool isPlaying() const { return playing_; }
  // Moves on by so many seconds of the session, leaving frames out where they are long; or, with
  // everyFrame, by exactly one frame, as a run replays it. Stops at the last frame.
  void advance(double seconds);

  bool everyFrame = true;

 private:
  Session session_;
  double timeStep_ = 0.0;
  std::size_t frame_ = 0;
  double rest_ = 0.0;  // seconds since frame_ was due
  bool playing_ = false;
};

}  // namespace hlodbench
