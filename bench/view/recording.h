#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hlod/view/camera.h"

namespace hlodbench {

// Poses recorded so far, with undo.
class Recording {
 public:
  explicit Recording(double step);  // seconds between poses
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] const std::vector<Pose>& poses() const { return poses_; }
  [[nodiscard]] bool empty() const { return poses_.empty(); }

  // What is appended from now on is one step of undo. A stretch to which nothing is appended is
  // none; what is appended after a cut or an undo without this begins a stretch too.
  void beginStretch();
  void append(std::span<const Pose> poses);
  // `frame` stays, as the last one. One step of undo; where nothing is after it, nothing happens.
  void cutAfter(std::size_t frame);

  [[nodiscard]] bool canUndo() const { return !steps_.empty(); }
  // Takes back the last stretch or the last cut; nothing if there is none.
  void undo();

 private:
  // Its undo leaves `kept` poses and puts `removed` behind them.
  struct Step {
    std::size_t kept;
    std::vector<Pose> removed;
  };

  double step_;
  std::vector<Pose> poses_;
  std::vector<Step> steps_;
  bool isInStretch_ = false;  // append() adds to the last step
};

}  // namespace hlodbench
