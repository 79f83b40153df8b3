#pragma once

#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/scene/courtyard_body.h"

// The primitives all bodies are made of. Lengths are metres; `detail` multiplies the density, so
// that detailed bodies get smaller triangles than plain ones.
namespace hlodbench::courtyard {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTau = 2.0 * kPi;

// Number of cells for a length, at least `least`.
int computeCells(double length, double density, int least);

// A smooth step from 0 (x <= low) to 1 (x >= high).
double computeStep(double low, double high, double x);

// A box of the given size about the origin. shape gets a point of the box's surface and returns
// where it goes.
Body makeBox(const glm::dvec3& size, double detail,
             std::function<glm::dvec3(const glm::dvec3&)> shape = {});

// A box with edges rounded by `radius` (at most half the shortest side).
// displace returns the height to add outwards at a point of the surface.
Body makeRoundedBox(const glm::dvec3& size, double radius, double detail,
                    std::function<double(const glm::dvec3&)> displace = {});

// A sphere cut like a cube, so that triangles are of nearly one size. shape gets the direction
// from the centre (unit length) and returns the position; `radius` only sets the fineness.
Body makeSphere(double radius, double detail, std::function<glm::dvec3(const glm::dvec3&)> shape);

// A curve of (radius, y) points from bottom to top, sampled by arc length.
class Profile {
 public:
  // smooth: a Catmull-Rom curve through the points instead of straight lines. All radii > 0.
  Profile(const std::vector<glm::dvec2>& points, bool smooth);

  [[nodiscard]] glm::dvec2 at(double share) const;  // share of the length, 0 to 1
  [[nodiscard]] double length() const { return lengths_.back(); }
  [[nodiscard]] double meanRadius() const { return meanRadius_; }

 private:
  std::vector<glm::dvec2> points_;
  std::vector<double> lengths_;
  double meanRadius_ = 0.0;
};

// A point of a turned body before it is shaped.
struct TurnedPoint {
  double radius, y, angle;  // angle: radians from +x towards +z
  double share;             // of the profile's length, 0 to 1

  [[nodiscard]] glm::dvec3 position() const;  // on the surface of revolution itself
};

// A surface of revolution about y, closed by discs at both ends of the profile; shape may move
// each point (default: position()). around > 1: so many times more cells around than along.
Body makeTurned(const Profile& profile, double detail,
                std::function<glm::dvec3(const TurnedPoint&)> shape = {}, double around = 1.0);

// A tube along a spine over s in [0, 1] with flat ends. radius(s, angle) > 0. `side` must never be
// parallel to the spine's direction. length and thickness (a mean radius) set the fineness.
struct TubeSpec {
  std::function<glm::dvec3(double)> spine;
  std::function<double(double, double)> radius;
  glm::dvec3 side{0.0, 0.0, 1.0};
  double length = 1.0;
  double thickness = 0.1;
};
Body makeTube(const TubeSpec& spec, double detail);

// A (turns, windings) torus knot lying around the y axis; the two numbers have no common factor.
// radius(t, angle), t in [0, 1) along the knot, is the tube's radius.
struct KnotSpec {
  int turns = 2;
  int windings = 3;
  double major = 0.4;
  double minor = 0.18;
  double thickness = 0.08;
  std::function<double(double, double)> radius;  // default: thickness
};
Body makeKnot(const KnotSpec& spec, double detail);

}  // namespace hlodbench::courtyard
