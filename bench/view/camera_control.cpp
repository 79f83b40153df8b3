#include "view/camera_control.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "view/scene_fit.h"

namespace hlodbench {
namespace {

constexpr double kLongestFrame = 0.1;  // seconds; a stall is no leap
constexpr double kMotionSeconds = 0.7;
constexpr double kFastFactor = 4.0;

const double kSteepest = glm::radians(89.0);  // pitch that turning reaches
const double kStartPitch = glm::radians(-20.0), kStartYaw = glm::radians(20.0);
const double kOrbitTurn = glm::pi<double>();             // radians over the picture's height
const double kLookTurn = glm::half_pi<double>();         // likewise
constexpr double kLevel = 1e-9;                          // radians of roll that are rounding
constexpr double kDistanceFactor = 0.85;                 // of an orbit, a notch
constexpr double kOrbitRate = 1.0;                       // distances to the pivot a second
constexpr double kSpeedFactor = 1.25;                    // a notch
constexpr double kStartSpeed = 0.15;                     // radii a second
constexpr double kLeastSpeed = 1e-4, kMostSpeed = 10.0;  // radii a second
// What the pivot keeps from the near and the far plane, as factors.
constexpr double kLeastDistance = 2.0, kMostDistance = 0.75;
constexpr double kNear = 0.2;  // radii to what goTo() goes to, at most

bool takesOver(const CameraInput& input) {
  return input.move != glm::dvec3(0.0) || input.turn != glm::dvec2(0.0) ||
         input.pan != glm::dvec2(0.0);
}

}  // namespace

CameraControl::CameraControl(const Aabb& scene, const Lens& lens, const glm::dvec3& up)
    : scene_(scene), radius_(computeRadius(scene)), axes_(up), lens_(lens) {
  reset();
}

void CameraControl::reset() {
  motion_.reset();
  speed_ = kStartSpeed * radius_;
  setAngles({kStartYaw, kStartPitch, 0.0});
  pivot_ = computeCentre(scene_);
  setDistance(computeFitDistance(scene_, lens_, pose_.orientation));
}

void CameraControl::setMode(CameraMode mode) {
  motion_.reset();
  mode_ = mode;
  if (mode != CameraMode::kFly && std::abs(angles_.roll) > kLevel)
    setAngles({angles_.yaw, angles_.pitch, 0.0});
  choosePivot();
}

void CameraControl::setPose(const Pose& pose) {
  motion_.reset();
  pose_ = pose;
  angles_ = axes_.toAngles(pose.orientation);
  choosePivot();
}

void CameraControl::update(const CameraInput& input, const Lens& lens) {
  lens_ = lens;
  const double seconds = std::clamp(input.seconds, 0.0, kLongestFrame);
  if (takesOver(input)) motion_.reset();
  if (motion_ && seconds > 0.0) advanceMotion(seconds);
  if (input.turn != glm::dvec2(0.0)) applyTurn(input.turn);
  if (input.pan != glm::dvec2(0.0)) applyPan(input.pan);
  // A motion has the say over the distance.
  if (input.wheel != 0.0 && !(motion_ && mode_ == CameraMode::kOrbit)) applyWheel(input.wheel);
  if (input.move != glm::dvec3(0.0) && seconds > 0.0) applyMove(input.move, input.fast, seconds);
}

void CameraControl::applyTurn(const glm::dvec2& pixels) {
  const bool isOrbit = mode_ == CameraMode::kOrbit;
  const double perPixel = (isOrbit ? kOrbitTurn : kLookTurn) / lens_.height;
  ViewAngles angles = angles_;
  angles.yaw = std::remainder(angles.yaw - perPixel * pixels.x, glm::two_pi<double>());
  // A pose that is steeper already stays so until it is turned back.
  angles.pitch = std::clamp(angles.pitch - perPixel * pixels.y, std::min(-kSteepest, angles.pitch),
                            std::max(kSteepest, angles.pitch));
  if (mode_ != CameraMode::kFly) angles.roll = 0.0;
  const double before = distance();
  setAngles(angles);
  if (isOrbit)
    pose_.position = pivot_ - before * forward();
  else
    pivot_ = pose_.position + before * forward();
}

void CameraControl::applyPan(const glm::dvec2& pixels) {
  const double perPixel = 2.0 * distance() * std::tan(0.5 * lens_.fovyRad) / lens_.height;
  shift(perPixel * (moveAxes() * glm::dvec3(-pixels.x, pixels.y, 0.0)));
}

void CameraControl::applyWheel(double notches) {
  if (mode_ == CameraMode::kOrbit)
    setDistance(limitDistance(distance() * std::pow(kDistanceFactor, notches)));
  else
    speed_ = std::clamp(speed_ * std::pow(kSpeedFactor, notches), kLeastSpeed * radius_,
                        kMostSpeed * radius_);
}

void CameraControl::applyMove(const glm::dvec3& move, bool fast, double seconds) {
  // Two keys at once are no faster than one.
  const glm::dvec3 direction = move / std::max(1.0, glm::length(move));
  const double factor = fast ? kFastFactor : 1.0;
  const double before = distance();
  if (mode_ == CameraMode::kOrbit) {
    // The distance falls exponentially, and the speed sideways with it: the way sideways is the
    // integral, so that many short frames end where a long one does.
    const double length = kOrbitRate * factor * seconds;
    const double after = limitDistance(before * std::exp(-length * direction.z));
    const double fall = std::log(before / after);
    const double mean = std::abs(fall) > 1e-6 ? (before - after) / fall : before;
    shift(length * mean * (moveAxes() * glm::dvec3(direction.x, direction.y, 0.0)));
    if (direction.z != 0.0) setDistance(after);
    return;
  }
  pose_.position +=
      speed_ * factor * seconds * (moveAxes() * glm::dvec3(direction.x, direction.y, -direction.z));
  // What one comes to stays the pivot until one is there.
  const double along = glm::dot(pivot_ - pose_.position, forward());
  pivot_ = pose_.position + std::max(along, std::min(before, kNear * radius_)) * forward();
}

void CameraControl::goTo(const glm::dvec3& point) {
  const glm::dvec3 eye = pose_.position;
  glm::dvec3 way = point - eye;
  double height = 0.0;  // of the eye above the point that stays
  if (mode_ == CameraMode::kWalk) {
    height = -glm::dot(way, axes_.up());
    way += height * axes_.up();
  }
  const double away = glm::length(way);
  const double near = limitDistance(std::min(away, kNear * radius_));
  const glm::dvec3 ahead = away > 0.0 ? way / away : moveAxes() * glm::dvec3(0.0, 0.0, -1.0);
  Motion motion{eye, point - near * ahead + height * axes_.up(), point, angles_, {}};
  motion.to = axes_.lookAlong(near * ahead - height * axes_.up());
  motion.to.pitch = std::clamp(motion.to.pitch, -kSteepest, kSteepest);
  motion.to.yaw = angles_.yaw + std::remainder(motion.to.yaw - angles_.yaw, glm::two_pi<double>());
  if (mode_ != CameraMode::kWalk)  // so that the point is ahead from the steepest view too
    motion.toEye = point - near * (axes_.toOrientation(motion.to) * glm::dvec3(0.0, 0.0, -1.0));
  motion_ = motion;
}

void CameraControl::advanceMotion(double seconds) {
  Motion& motion = *motion_;
  motion.seconds += seconds;
  // The last part may be what rounding left.
  const bool isThere = motion.seconds >= kMotionSeconds * (1.0 - 1e-9);
  const double time = isThere ? 1.0 : motion.seconds / kMotionSeconds;
  const double share = time * time * (3.0 - 2.0 * time);
  setAngles({glm::mix(motion.from.yaw, motion.to.yaw, share),
             glm::mix(motion.from.pitch, motion.to.pitch, share),
             glm::mix(motion.from.roll, motion.to.roll, share)});
  pose_.position = isThere ? motion.toEye : glm::mix(motion.fromEye, motion.toEye, share);
  // Wherever it is ended, what it goes to is about as far as the pivot.
  pivot_ = pose_.position + glm::distance(pose_.position, motion.point) * forward();
  if (isThere) motion_.reset();
}

double CameraControl::speed() const {
  return mode_ == CameraMode::kOrbit ? kOrbitRate * distance() : speed_;
}

void CameraControl::setAngles(const ViewAngles& angles) {
  angles_ = angles;
  pose_.orientation = axes_.toOrientation(angles);
}

void CameraControl::setDistance(double distance) {
  pose_.position = pivot_ - distance * forward();
}

void CameraControl::shift(const glm::dvec3& way) {
  pose_.position += way;
  pivot_ += way;
}

glm::dquat CameraControl::moveAxes() const {
  if (mode_ != CameraMode::kWalk) return pose_.orientation;
  return axes_.toOrientation({angles_.yaw, 0.0, 0.0});
}

void CameraControl::choosePivot() {
  const glm::dvec3 ahead = forward();
  const double along = glm::dot(pivot_ - pose_.position, ahead);
  const glm::dvec3 onAxis = pose_.position + along * ahead;
  if (along > 0.0 && glm::distance(onAxis, pivot_) <= 1e-6 * along) return;
  // As far as the middle of the scene, or near where that is not ahead.
  const double toCentre = glm::dot(computeCentre(scene_) - pose_.position, ahead);
  pivot_ = pose_.position + std::max(toCentre, kNear * radius_) * ahead;
}

double CameraControl::limitDistance(double wanted) const {
  // A distance that is out of bounds already, as another lens makes it, is no leap.
  const double least = std::min(kLeastDistance * lens_.nearPlane, distance());
  return std::clamp(wanted, least, std::max(kMostDistance * lens_.farPlane, distance()));
}

}  // namespace hlodbench
