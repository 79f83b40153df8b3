#pragma once

#include <span>
#include <vector>

#include "hlod/view/camera.h"

namespace hlodbench {

// Paths are poses at a fixed time step.

// Between two poses: the position on the straight line, the orientation by slerp the short way.
// share: 0 to 1; 0 gives `a` and 1 gives `b` bit by bit.
Pose interpolatePose(const Pose& a, const Pose& b, double share);

// The same path at another time step, seconds, both above 0. The first pose is kept, and the last
// one if the path is a whole number of the new steps long; what is left over of it is dropped.
std::vector<Pose> resamplePoses(std::span<const Pose> poses, double fromStep, double toStep);

// Every pose becomes the Gaussian weighted mean of its neighbours; step and sigma in seconds.
// Beyond its ends the path counts as mirrored through them, so the first and the last pose stay
// where they are and a straight way at constant speed stays as it is. Quaternions stay unit. sigma
// 0 returns the input.
std::vector<Pose> smoothPoses(std::span<const Pose> poses, double step, double sigma);

}  // namespace hlodbench
