#include "view/recording.h"

#include <iterator>
#include <utility>

namespace hlodbench {

Recording::Recording(double step) : step_(step) {}

void Recording::beginStretch() {
  isInStretch_ = false;
}

void Recording::append(std::span<const Pose> poses) {
  if (poses.empty()) return;
  if (!isInStretch_) steps_.push_back({poses_.size(), {}});
  isInStretch_ = true;
  poses_.insert(poses_.end(), poses.begin(), poses.end());
}

void Recording::cutAfter(std::size_t frame) {
  if (frame >= poses_.size() || frame + 1 == poses_.size()) return;
  const std::size_t kept = frame + 1;
  const auto end = std::next(poses_.begin(), static_cast<std::ptrdiff_t>(kept));
  steps_.push_back({kept, {end, poses_.end()}});
  poses_.resize(kept);
  isInStretch_ = false;
}

void Recording::undo() {
  if (steps_.empty()) return;
  const Step step = std::move(steps_.back());
  steps_.pop_back();
  poses_.resize(step.kept);
  poses_.insert(poses_.end(), step.removed.begin(), step.removed.end());
  isInStretch_ = false;
}

}  // namespace hlodbench
