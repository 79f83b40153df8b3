#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hlod/view/camera.h"

namespace hlodbench {

// Turns poses at irregular times, those of displayed frames, into poses at a fixed step. A pose
// that is due between two frames is interpolated.
//
// A stretch begins with the pose at which it was begun, and has one pose a step from there. Where a
// stretch goes on from the very pose that was given out last, that pose is recorded already: it is
// not given out again, and the first one of the stretch is a step later, as if there had been no
// pause. Standing still within a stretch gives equal poses, as it should.
class PoseSampler {
 public:
  explicit PoseSampler(double step);  // seconds, above 0
  // The next add() begins a stretch.
  void restart();
  // As restart(), for when the last pose recorded is not the last one given out: after a cut or an
  // undo.
  void restartAfter(const Pose& last);
  // time: seconds, not decreasing within a stretch. Returns the poses that became due, in order;
  // the first add() of a stretch gives its pose out at once.
  std::vector<Pose> add(double time, const Pose& pose);

 private:
  double step_;
  bool isBegun_ = false;
  double begin_ = 0.0;            // seconds; when pose 0 of the stretch was due
  std::uint64_t due_ = 0;         // the stretch's next pose
  double time_ = 0.0;             // of the last add()
  Pose pose_;                     // of the last add()
  std::optional<Pose> recorded_;  // what a stretch goes on from
};

}  // namespace hlodbench
