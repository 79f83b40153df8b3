#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "hlod/core/aabb.h"
#include "hlod/view/camera.h"
#include "view/view_angles.h"

namespace hlodbench {

// kOrbit goes round a pivot, kFly through the air, kWalk over a level ground.
enum class CameraMode { kOrbit, kFly, kWalk };

// What the user did since the last frame.
struct CameraInput {
  glm::dvec3 move{0.0};  // right, up, forward: -1 to 1 each; held keys
  glm::dvec2 turn{0.0};  // pointer movement while turning, pixels, right and down positive
  glm::dvec2 pan{0.0};   // pointer movement while panning, pixels
  double wheel = 0.0;    // notches; away from the user positive
  bool fast = false;     // 4 times the speed
  double seconds = 0.0;  // since the last frame; more than 0.1 counts as 0.1
};

// Moves a camera by what the user does. It never adds roll, and where it ends does not depend on
// how the time is cut into frames. Without input, and unless it is going somewhere, the pose stays
// bit by bit.
//
// Orbit: turning goes round the pivot, panning moves eye and pivot so that what is as far as the
// pivot follows the pointer, the wheel comes nearer or goes farther by a factor; keys pan and come
// nearer too. Fly: turning looks round, keys move along the view's axes, the wheel changes the
// speed. Walk: as fly, but right and forward keep the height, which only up and panning change.
class CameraControl {
 public:
  // scene: box of everything, world units, may be empty; up: unit vector.
  CameraControl(const Aabb& scene, const Lens& lens, const glm::dvec3& up = {0.0, 1.0, 0.0});

  // The pose stays, but that walking and orbiting put the horizon level.
  void setMode(CameraMode mode);
  [[nodiscard]] CameraMode mode() const { return mode_; }
  // To the start: a view of the whole scene from slightly above, and the speed that fits the scene.
  void reset();
  void update(const CameraInput& input, const Lens& lens);

  [[nodiscard]] const Pose& pose() const { return pose_; }
  // Any pose, bit by bit. Roll that it has stays until the user turns the camera in a mode that is
  // level. An orbit's pivot stays if it is ahead of the eye, and else comes to be there.
  void setPose(const Pose& pose);

  // Begins a smooth motion, 0.7 s of update()'s time, that ends near the point, which is then the
  // pivot and in the middle of the picture; walking keeps the height. Any move, turn or pan ends
  // it, and so do setMode(), reset() and setPose().
  void goTo(const glm::dvec3& point);
  [[nodiscard]] bool isGoing() const { return motion_.has_value(); }

  // What a held key moves, without `fast`; world units a second. An orbit's grows with the
  // distance.
  [[nodiscard]] double speed() const;
  // What an orbit turns about; ahead of the eye.
  [[nodiscard]] const glm::dvec3& pivot() const { return pivot_; }

 private:
  struct Motion {
    glm::dvec3 fromEye, toEye, point;
    ViewAngles from, to;
    double seconds = 0.0;  // so far
  };

  void applyTurn(const glm::dvec2& pixels);
  void applyPan(const glm::dvec2& pixels);
  void applyWheel(double notches);
  void applyMove(const glm::dvec3& move, bool fast, double seconds);
  void advanceMotion(double seconds);
  void setAngles(const ViewAngles& angles);
  void setDistance(double distance);  // of the eye from the pivot, which stays
  void shift(const glm::dvec3& way);  // eye and pivot
  void choosePivot();
  [[nodiscard]] double distance() const { return glm::distance(pose_.position, pivot_); }
  [[nodiscard]] double limitDistance(double wanted) const;
  // What right, up and back are for keys and panning.
  [[nodiscard]] glm::dquat moveAxes() const;
  [[nodiscard]] glm::dvec3 forward() const { return pose_.orientation * glm::dvec3(0, 0, -1); }

  Aabb scene_;
  double radius_;  // of the scene, world units
  ViewAxes axes_;
  Lens lens_;  // of the last update()
  CameraMode mode_ = CameraMode::kOrbit;
  Pose pose_;
  ViewAngles angles_;  // of the pose
  glm::dvec3 pivot_{0.0};
  double speed_ = 1.0;  // of flying and walking
  std::optional<Motion> motion_;
};

// A lens for a scene that has none of its own: the whole scene is visible from the start of a
// CameraControl and from twice as far, and its planes are near enough to each other for a depth
// buffer of 24 bits. fovyRad: vertical, above 0 and below pi.
Lens chooseLens(const Aabb& scene, int width, int height, double fovyRad);

}  // namespace hlodbench
