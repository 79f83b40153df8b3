#include "hlod/scene/courtyard_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hlodbench::courtyard {
namespace {

// A vertex of the block in [-1, 1]^3.
glm::dvec3 computeUnit(const Lattice& lattice, const glm::ivec3& vertex) {
  return 2.0 * glm::dvec3(vertex) / glm::dvec3(lattice.cells) - 1.0;
}

std::function<Lattice(double)> makeBoxLattice(const glm::dvec3& size, double detail) {
  return [size, detail](double density) {
    Lattice lattice;
    for (int axis = 0; axis < 3; ++axis) {
      lattice.cells[axis] = computeCells(size[axis], density * detail, 1);
    }
    return lattice;
  };
}

// The angle of a point of the square [-1, 1]^2, equal steps along the border giving equal angles
// (Shirley and Chiu's concentric map, 1997).
double computeSquareAngle(double a, double b) {
  if (a == 0.0 && b == 0.0) return 0.0;
  if (std::abs(a) >= std::abs(b)) return (a > 0 ? 0.0 : kPi) + kPi / 4 * b / a;
  return (b > 0 ? kPi / 2 : -kPi / 2) - kPi / 4 * a / b;
}

std::vector<glm::dvec2> smoothCurve(const std::vector<glm::dvec2>& points) {
  constexpr int kParts = 8;
  std::vector<glm::dvec2> out;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::dvec2 p0 = points[i == 0 ? 0 : i - 1], p1 = points[i], p2 = points[i + 1];
    const glm::dvec2 p3 = points[std::min(i + 2, points.size() - 1)];
    for (int part = 0; part < kParts; ++part) {
      const double t = static_cast<double>(part) / kParts;
      out.push_back(0.5 *
                    (2.0 * p1 + (p2 - p0) * t + (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * t * t +
                     (3.0 * p1 - p0 - 3.0 * p2 + p3) * t * t * t));
      out.back().x = std::max(out.back().x, 1e-3);
    }
  }
  out.push_back(points.back());
  return out;
}

}  // namespace

int computeCells(double length, double density, int least) {
  return std::max(least, static_cast<int>(std::lround(length * density)));
}

double computeStep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

Body makeBox(const glm::dvec3& size, double detail,
             std::function<glm::dvec3(const glm::dvec3&)> shape) {
  return {makeBoxLattice(size, detail), [half = 0.5 * size, shape = std::move(shape)](
                                            const Lattice& lattice, const glm::ivec3& vertex) {
            const glm::dvec3 point = half * computeUnit(lattice, vertex);
            return shape ? shape(point) : point;
          }};
}

Body makeRoundedBox(const glm::dvec3& size, double radius, double detail,
                    std::function<double(const glm::dvec3&)> displace) {
  const glm::dvec3 core = 0.5 * size - radius;
  return makeBox(size, detail, [core, radius, displace](const glm::dvec3& point) {
    const glm::dvec3 inner = glm::clamp(point, -core, core);
    const glm::dvec3 normal = glm::normalize(point - inner);
    const glm::dvec3 surface = inner + radius * normal;
    return displace ? surface + displace(surface) * normal : surface;
  });
}

Body makeSphere(double radius, double detail, std::function<glm::dvec3(const glm::dvec3&)> shape) {
  return {[radius, detail](double density) {
            Lattice lattice;
            lattice.cells = glm::ivec3(computeCells(radius * kPi / 2, density * detail, 2));
            return lattice;
          },
          [shape = std::move(shape)](const Lattice& lattice, const glm::ivec3& vertex) {
            const glm::dvec3 unit = computeUnit(lattice, vertex);
            return shape(glm::normalize(glm::tan(unit * (kPi / 4))));
          }};
}

Profile::Profile(const std::vector<glm::dvec2>& points, bool smooth)
    : points_(smooth ? smoothCurve(points) : points), lengths_{0.0} {
  double weighted = 0.0;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double step = glm::length(points_[i] - points_[i - 1]);
    weighted += step * 0.5 * (points_[i].x + points_[i - 1].x);
    lengths_.push_back(lengths_.back() + step);
  }
  meanRadius_ = weighted / lengths_.back();
}

glm::dvec2 Profile::at(double share) const {
  const double wanted = share * length();
  const auto it = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, wanted);
  const auto i = static_cast<std::size_t>(it - lengths_.begin());
  const double step = lengths_[i] - lengths_[i - 1];
  const double t = step > 0.0 ? std::min((wanted - lengths_[i - 1]) / step, 1.0) : 0.0;
  return points_[i - 1] + t * (points_[i] - points_[i - 1]);
}

glm::dvec3 TurnedPoint::position() const {
  return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

Body makeTurned(const Profile& profile, double detail,
                std::function<glm::dvec3(const TurnedPoint&)> shape, double around) {
  const double length = profile.length();
  const double quarter = kTau * profile.meanRadius() / 4 * around;
  return {[length, quarter, detail](double density) {
            const int across = computeCells(quarter, density * detail, 2);
            Lattice lattice;
            lattice.cells = {across, computeCells(length, density * detail, 3), across};
            return lattice;
          },
          [profile, shape = std::move(shape)](const Lattice& lattice, const glm::ivec3& vertex) {
            const glm::dvec3 unit = computeUnit(lattice, vertex);
            const double share = 0.5 * (unit.y + 1.0);
            const glm::dvec2 at = profile.at(share);
            // The side's vertices lie on the square's border; only the end discs have inner ones.
            const double ring = std::max(std::abs(unit.x), std::abs(unit.z));
            const TurnedPoint point{at.x * ring, at.y, computeSquareAngle(unit.x, unit.z), share};
            return shape ? shape(point) : point.position();
          }};
}

Body makeTube(const TubeSpec& spec, double detail) {
  const Profile line({{1.0, 0.0}, {1.0, 1.0}}, false);
  Body body = makeTurned(line, detail, [spec](const TurnedPoint& p) {
    constexpr double kStep = 1e-4;
    const glm::dvec3 ahead = spec.spine(std::min(p.share + kStep, 1.0));
    const glm::dvec3 behind = spec.spine(std::max(p.share - kStep, 0.0));
    const glm::dvec3 along = glm::normalize(ahead - behind);
    const glm::dvec3 x = glm::normalize(glm::cross(along, spec.side));
    const glm::dvec3 z = glm::cross(x, along);
    const double radius = p.radius * spec.radius(p.share, p.angle);
    return spec.spine(p.share) + radius * (std::cos(p.angle) * x + std::sin(p.angle) * z);
  });
  body.lattice = [length = spec.length, quarter = kTau * spec.thickness / 4,
                  detail](double density) {
    const int across = computeCells(quarter, density * detail, 2);
    Lattice lattice;
    lattice.cells = {across, computeCells(length, density * detail, 4), across};
    return lattice;
  };
  return body;
}

Body makeKnot(const KnotSpec& spec, double detail) {
  const double length =
      kTau * std::hypot(spec.turns * spec.major, static_cast<double>(spec.windings) * spec.minor);
  const auto centre = [spec](double t) {
    const double wind = kTau * spec.windings * t, turn = kTau * spec.turns * t;
    const double distance = spec.major + spec.minor * std::cos(wind);
    return glm::dvec3(distance * std::cos(turn), spec.minor * std::sin(wind),
                      distance * std::sin(turn));
  };
  return {[length, girth = kTau * spec.thickness, detail,
           least = 6 * (spec.turns + spec.windings)](double density) {
            Lattice lattice;
            lattice.topology = Lattice::Topology::kTorus;
            lattice.cells = {computeCells(length, density * detail, least),
                             computeCells(girth, density * detail, 5), 1};
            return lattice;
          },
          [spec, centre](const Lattice& lattice, const glm::ivec3& vertex) {
            constexpr double kStep = 1e-5;
            const double t = static_cast<double>(vertex.x) / lattice.cells.x;
            const double angle = kTau * vertex.y / lattice.cells.y;
            const double wind = kTau * spec.windings * t, turn = kTau * spec.turns * t;
            const glm::dvec3 along = glm::normalize(centre(t + kStep) - centre(t - kStep));
            const glm::dvec3 out(std::cos(wind) * std::cos(turn), std::sin(wind),
                                 std::cos(wind) * std::sin(turn));
            const glm::dvec3 side = glm::normalize(glm::cross(along, out));
            const glm::dvec3 up = glm::cross(side, along);
            const double radius = spec.radius ? spec.radius(t, angle) : spec.thickness;
            return centre(t) + radius * (std::cos(angle) * up - std::sin(angle) * side);
          }};
}

}  // namespace hlodbench::courtyard
