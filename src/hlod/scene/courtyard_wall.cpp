#include "hlod/scene/courtyard_wall.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hlod/scene/courtyard_noise.h"
#include "hlod/scene/courtyard_shapes.h"

namespace hlodbench::courtyard {
namespace {

using Kind = WallBay::Kind;

// How far up the arch's base the part above it fans out, as a share of the margin beside it.
constexpr double kFan = 0.5;
constexpr double kRingWidth = 0.24;   // of the raised stones around an opening, metres
constexpr double kRingHeight = 0.05;  // how far they stand out

// A part of the wall between two neighbouring column breaks of its lattice.
struct Part {
  std::size_t bay;
  bool opening;              // the part under and above an arch
  double left, right;        // x at the height of the openings
  double topLeft, topRight;  // x at the wall's top
};

class WallShape {
 public:
  explicit WallShape(const WallSpec& spec);

  [[nodiscard]] Lattice computeLattice(double density) const;
  [[nodiscard]] glm::dvec3 place(const Lattice& lattice, const glm::ivec3& vertex) const;

 private:
  [[nodiscard]] glm::dvec2 computeArch(const Part& part, double share) const;
  [[nodiscard]] glm::dvec2 placeInPlane(const Lattice& lattice, int i, int j) const;
  [[nodiscard]] double computeRelief(const glm::dvec2& at, std::uint64_t side) const;

  WallSpec spec_;
  std::vector<Part> parts_;
  std::vector<double> centres_;  // of the bays
  std::array<double, 4> rows_;   // bottom, sill, spring, top
};

WallShape::WallShape(const WallSpec& spec)
    : spec_(spec), rows_{spec.bottom, spec.sill, spec.spring, spec.top} {
  double x = 0.0;
  for (const WallBay& bay : spec.bays) x -= 0.5 * bay.width;
  for (std::size_t b = 0; b < spec.bays.size(); ++b) {
    const WallBay& bay = spec.bays[b];
    const double right = x + bay.width, centre = x + 0.5 * bay.width;
    centres_.push_back(centre);
    if (bay.kind == Kind::kBlank) {
      parts_.push_back({b, false, x, right, x, right});
    } else {
      const double half = bay.halfOpening;
      const double fan = half + kFan * (0.5 * bay.width - half);
      parts_.push_back({b, false, x, centre - half, x, centre - fan});
      parts_.push_back({b, true, centre - half, centre + half, centre - fan, centre + fan});
      parts_.push_back({b, false, centre + half, right, centre + fan, right});
    }
    x = right;
  }
}

Lattice WallShape::computeLattice(double density) const {
  Lattice lattice;
  lattice.xBreaks = {0};
  for (const Part& part : parts_) {
    const double length = (part.right - part.left) * (part.opening ? kPi / 2 : 1.0);
    lattice.xBreaks.push_back(lattice.xBreaks.back() +
                              computeCells(length, density, part.opening ? 4 : 1));
  }
  lattice.yBreaks = {0};
  for (std::size_t row = 0; row < 3; ++row) {
    const double height = rows_[row + 1] - rows_[row];
    lattice.yBreaks.push_back(lattice.yBreaks.back() +
                              (height > 0.0 ? computeCells(height, density, 1) : 0));
  }
  lattice.cells = {lattice.xBreaks.back(), lattice.yBreaks.back(),
                   computeCells(spec_.thickness, density, 1)};
  const auto nx = static_cast<std::size_t>(lattice.cells.x);
  lattice.removed.assign(nx * static_cast<std::size_t>(lattice.cells.y), false);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (!parts_[p].opening) continue;
    const bool door = spec_.bays[parts_[p].bay].kind == Kind::kDoor;
    for (int j = door ? 0 : lattice.yBreaks[1]; j < lattice.yBreaks[2]; ++j)
      for (int i = lattice.xBreaks[p]; i < lattice.xBreaks[p + 1]; ++i)
        lattice.removed[static_cast<std::size_t>(j) * nx + static_cast<std::size_t>(i)] = true;
  }
  return lattice;
}

// The arch over an opening, or the level line beside it, at a share of the part's columns. The
// two arcs of a pointed arch have their centres beyond the middle of the opening.
glm::dvec2 WallShape::computeArch(const Part& part, double share) const {
  if (!part.opening) return {part.left + share * (part.right - part.left), spec_.spring};
  const double half = 0.5 * (part.right - part.left), shift = spec_.pointed * half;
  const double fromSide = share <= 0.5 ? 2.0 * share : 2.0 * (1.0 - share);
  const double angle = fromSide * std::acos(shift / (half + shift));
  const double x = shift - (half + shift) * std::cos(angle);
  return {centres_[part.bay] + (share <= 0.5 ? x : -x),
          spec_.spring + (half + shift) * std::sin(angle)};
}

glm::dvec2 WallShape::placeInPlane(const Lattice& lattice, int i, int j) const {
  const auto& xs = lattice.xBreaks;
  const auto& ys = lattice.yBreaks;
  const auto found = std::upper_bound(xs.begin() + 1, xs.end() - 1, i);
  const auto p = static_cast<std::size_t>(found - xs.begin()) - 1;
  const Part& part = parts_[p];
  const double share = static_cast<double>(i - xs[p]) / (xs[p + 1] - xs[p]);
  const glm::dvec2 arch = computeArch(part, share);
  if (j >= ys[2]) {
    const double up = static_cast<double>(j - ys[2]) / (ys[3] - ys[2]);
    const glm::dvec2 top(part.topLeft + share * (part.topRight - part.topLeft), spec_.top);
    return glm::mix(arch, top, up);
  }
  const std::size_t row = j >= ys[1] ? 1 : 0;
  const double up = static_cast<double>(j - ys[row]) / (ys[row + 1] - ys[row]);
  return {arch.x, rows_[row] + up * (rows_[row + 1] - rows_[row])};
}

double WallShape::computeRelief(const glm::dvec2& at, std::uint64_t side) const {
  const std::uint64_t seed = spec_.seed * 2 + side;
  double height =
      spec_.relief * computeMasonry(at.x, at.y, spec_.blockLength, spec_.courseHeight, seed) +
      0.4 * spec_.relief * computeFractalNoise({1.9 * at.x, 1.9 * at.y, 0.5}, 3, seed ^ 0x51ULL);
  for (std::size_t b = 0; b < spec_.bays.size(); ++b) {
    const WallBay& bay = spec_.bays[b];
    const double dx = std::abs(at.x - centres_[b]);
    if (bay.kind == Kind::kBlank || dx > bay.halfOpening + 2.0 * kRingWidth) continue;
    const double shift = spec_.pointed * bay.halfOpening, dy = at.y - spec_.spring;
    double away = dx - bay.halfOpening;  // distance from the opening's border
    if (dy > 0.0) away = std::hypot(dx + shift, dy) - bay.halfOpening - shift;
    const bool under = bay.kind == Kind::kWindow && at.y < spec_.sill;
    const double ring = under ? 0.0 : 1.0 - computeStep(0.7 * kRingWidth, 1.2 * kRingWidth, away);
    const double joints = 0.75 + 0.25 * std::cos(std::atan2(dx, std::max(dy, 0.0)) * 18.0);
    height = height * (1.0 - ring) + ring * (spec_.relief + kRingHeight * joints);
  }
  return height;
}

glm::dvec3 WallShape::place(const Lattice& lattice, const glm::ivec3& vertex) const {
  const glm::dvec2 at = placeInPlane(lattice, vertex.x, vertex.y);
  const double half = 0.5 * spec_.thickness;
  const double through = static_cast<double>(vertex.z) / lattice.cells.z;
  return {at, glm::mix(-half - computeRelief(at, 0), half + computeRelief(at, 1), through)};
}

}  // namespace

Body makeWall(const WallSpec& spec, double detail) {
  const WallShape shape(spec);
  return {[shape, detail](double density) { return shape.computeLattice(density * detail); },
          [shape](const Lattice& lattice, const glm::ivec3& vertex) {
            return shape.place(lattice, vertex);
          }};
}

}  // namespace hlodbench::courtyard
