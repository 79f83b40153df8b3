#include "view/pose_sampler.h"

#include <algorithm>

#include "view/pose_path.h"

namespace hlodbench {
namespace {

// Of a step: a frame that rounding makes this much early is in time.
constexpr double kTolerance = 1e-9;

bool isSame(const Pose& a, const Pose& b) {
  return a.position == b.position && a.orientation == b.orientation;
}

}  // namespace

PoseSampler::PoseSampler(double step) : step_(step) {}

void PoseSampler::restart() {
  isBegun_ = false;
}

void PoseSampler::restartAfter(const Pose& last) {
  recorded_ = last;
  restart();
}

std::vector<Pose> PoseSampler::add(double time, const Pose& pose) {
  std::vector<Pose> given;
  if (!isBegun_) {
    isBegun_ = true;
    begin_ = time;
    due_ = 1;
    if (!recorded_ || !isSame(*recorded_, pose)) given.push_back(pose);
  } else {
    time = std::max(time, time_);
    // By multiplication: a sum of steps would drift.
    const auto timeOfDue = [this] { return begin_ + static_cast<double>(due_) * step_; };
    for (; timeOfDue() <= time + kTolerance * step_; ++due_) {
      const double share = time > time_ ? (timeOfDue() - time_) / (time - time_) : 1.0;
      given.push_back(interpolatePose(pose_, pose, share));
    }
  }
  time_ = time;
  pose_ = pose;
  if (!given.empty()) recorded_ = given.back();
  return given;
}

}  // namespace hlodbench
