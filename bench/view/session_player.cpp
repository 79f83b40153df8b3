#include "view/session_player.h"

#include <algorithm>
#include <cmath>

namespace hlodbench {

void SessionPlayer::load(Session session, double timeStep) {
  session_ = std::move(session);
  timeStep_ = session_.timeStep > 0.0 ? session_.timeStep : timeStep;
  frame_ = 0;
  rest_ = 0.0;
  playing_ = false;
}

void SessionPlayer::seek(std::size_t frame) {
  frame_ = std::min(frame, session_.poses.size() - 1);
  rest_ = 0.0;
  playing_ = false;
}

void SessionPlayer::step(long frames) {
  seek(static_cast<std::size_t>(std::max(0L, static_cast<long>(frame_) + frames)));
}

void SessionPlayer::play(bool on) {
  if (on && frame_ + 1 == session_.poses.size()) frame_ = 0;
  rest_ = 0.0;
  playing_ = on;
}

void SessionPlayer::advance(double seconds) {
  if (!playing_) return;
  rest_ += seconds;
  const double due = everyFrame ? 1.0 : std::floor(rest_ / timeStep_);
  rest_ = everyFrame ? 0.0 : rest_ - due * timeStep_;
  const double last = static_cast<double>(session_.poses.size() - 1);
  frame_ = static_cast<std::size_t>(std::min(last, static_cast<double>(frame_) + due));
  if (frame_ + 1 == session_.poses.size()) playing_ = false;
}

}  // namespace hlodbench
