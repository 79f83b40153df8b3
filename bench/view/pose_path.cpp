#include "view/pose_path.h"

#include <algorithm>
#include <cmath>

namespace hlodbench {
namespace {

// Of a step: what rounding may make of a whole number of steps.
constexpr double kStepTolerance = 1e-9;
constexpr double kWindow = 4.0;  // sigmas to either side; beyond, a weight is below 0.0004

}  // namespace

Pose interpolatePose(const Pose& a, const Pose& b, double share) {
  if (share <= 0.0) return a;
  if (share >= 1.0) return b;
  Pose pose;
  pose.position = glm::mix(a.position, b.position, share);
  pose.orientation = glm::normalize(glm::slerp(a.orientation, b.orientation, share));
  return pose;
}

std::vector<Pose> resamplePoses(std::span<const Pose> poses, double fromStep, double toStep) {
  if (poses.empty() || fromStep == toStep) return {poses.begin(), poses.end()};
  const std::size_t last = poses.size() - 1;
  const double ratio = toStep / fromStep;
  const double tolerance = kStepTolerance * std::max(1.0, ratio);
  const auto steps = static_cast<std::size_t>((static_cast<double>(last) + tolerance) / ratio);
  std::vector<Pose> resampled;
  resampled.reserve(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) {
    const double at = static_cast<double>(i) * ratio;
    const double nearest = std::round(at);
    if (std::abs(at - nearest) <= tolerance) {
      resampled.push_back(poses[std::min(static_cast<std::size_t>(nearest), last)]);
      continue;
    }
    const auto before = static_cast<std::size_t>(at);
    resampled.push_back(
        interpolatePose(poses[before], poses[before + 1], at - static_cast<double>(before)));
  }
  return resampled;
}

std::vector<Pose> smoothPoses(std::span<const Pose> poses, double step, double sigma) {
  std::vector<Pose> smoothed(poses.begin(), poses.end());
  if (!(sigma > 0.0)) return smoothed;
  const std::size_t count = poses.size();
  // No wider than the path, whatever sigma is.
  const auto reach = static_cast<std::size_t>(
      std::min(std::ceil(kWindow * sigma / step), static_cast<double>(count)));
  std::vector<double> weights(reach + 1);
  for (std::size_t k = 0; k <= reach; ++k) {
    const double distance = static_cast<double>(k) * step / sigma;
    weights[k] = std::exp(-0.5 * distance * distance);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t window = std::min({reach, i, count - 1 - i});
    if (window == 0) continue;
    const glm::dquat& middle = poses[i].orientation;
    glm::dvec3 position = weights[0] * poses[i].position;
    glm::dquat orientation = weights[0] * middle;
    double sum = weights[0];
    const auto add = [&](const Pose& pose, double weight) {
      position += weight * pose.position;
      // q and -q turn alike: the one on the middle's side, so that the sum is never near 0
      const double sign = glm::dot(pose.orientation, middle) < 0.0 ? -1.0 : 1.0;
      orientation = orientation + sign * weight * pose.orientation;
      sum += weight;
    };
    for (std::size_t k = 1; k <= window; ++k) {
      add(poses[i - k], weights[k]);
      add(poses[i + k], weights[k]);
    }
    smoothed[i].position = position / sum;
    smoothed[i].orientation = glm::normalize(orientation);
  }
  return smoothed;
}

}  // namespace hlodbench
