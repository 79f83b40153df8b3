#include "view/pose_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace hlodbench {
namespace {

// Of a step: what rounding may make of a whole number of steps.
constexpr double kStepTolerance = 1e-9;
constexpr double kWindow = 4.0;  // sigmas to either side; beyond, a weight is below 0.0004

// As far beyond the path's end as the pose is before it.
Pose mirror(const Pose& end, const Pose& pose) {
  return {2.0 * end.position - pose.position,
          end.orientation * glm::conjugate(pose.orientation) * end.orientation};
}

}  // namespace

Pose interpolatePose(const Pose& a, const Pose& b, double share) {
  if (share <= 0.0) return a;
  if (share >= 1.0) return b;
  Pose pose;
  // Written so that equal poses give the same bit by bit.
  pose.position = a.position + share * (b.position - a.position);
  pose.orientation = a.orientation == b.orientation
                         ? a.orientation
                         : glm::normalize(glm::slerp(a.orientation, b.orientation, share));
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
  if (!(sigma > 0.0) || poses.size() < 3) return smoothed;
  const auto last = static_cast<std::ptrdiff_t>(poses.size()) - 1;
  // No wider than the path, whatever sigma is: then one mirror at each end is enough.
  const auto reach = static_cast<std::ptrdiff_t>(
      std::min(std::ceil(kWindow * sigma / step), static_cast<double>(last)));
  std::vector<double> weights;
  for (std::ptrdiff_t k = 0; k <= reach; ++k) {
    const double distance = static_cast<double>(k) * step / sigma;
    weights.push_back(std::exp(-0.5 * distance * distance));
  }
  const auto at = [&](std::ptrdiff_t i) {
    if (i < 0) return mirror(poses.front(), poses[static_cast<std::size_t>(-i)]);
    if (i > last) return mirror(poses.back(), poses[static_cast<std::size_t>(2 * last - i)]);
    return poses[static_cast<std::size_t>(i)];
  };
  for (std::ptrdiff_t i = 1; i < last; ++i) {
    Pose& pose = smoothed[static_cast<std::size_t>(i)];
    const glm::dquat middle = pose.orientation;
    glm::dvec3 position{0.0};
    glm::dquat orientation{0.0, 0.0, 0.0, 0.0};
    double sum = 0.0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const Pose neighbour = at(i + k);
      const double weight = weights[static_cast<std::size_t>(std::abs(k))];
      // q and -q turn alike: the one on the middle's side, so that the sum is never near 0
      const double sign = glm::dot(neighbour.orientation, middle) < 0.0 ? -1.0 : 1.0;
      position += weight * neighbour.position;
      orientation = orientation + sign * weight * neighbour.orientation;
      sum += weight;
    }
    pose.position = position / sum;
    pose.orientation = glm::normalize(orientation);
  }
  return smoothed;
}

}  // namespace hlodbench
