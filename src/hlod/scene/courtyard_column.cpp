#include "hlod/scene/courtyard_column.h"

#include <algorithm>
#include <cmath>

#include "hlod/scene/courtyard_random.h"
#include "hlod/scene/courtyard_shapes.h"

namespace hlodbench::courtyard {
namespace {

// The base ends and the capital begins at these heights, in shaft radii from foot and top.
constexpr double kPlinthTop = 0.7, kBaseTop = 2.0, kCapitalFoot = 4.0, kAbacusFoot = 0.7;

Profile makeColumnProfile(const ColumnSpec& spec) {
  const double r = spec.radius, h = spec.height;
  return Profile({{1.62 * r, 0.0},
                  {1.62 * r, kPlinthTop * r},
                  {1.42 * r, kPlinthTop * r},
                  {1.56 * r, 0.85 * r},
                  {1.60 * r, 1.05 * r},
                  {1.50 * r, 1.25 * r},
                  {1.20 * r, 1.40 * r},
                  {1.16 * r, 1.55 * r},
                  {1.34 * r, 1.70 * r},
                  {1.30 * r, 1.88 * r},
                  {1.00 * r, kBaseTop * r},
                  {1.00 * r, 0.4 * h},
                  {0.86 * r, h - (kCapitalFoot + 0.35) * r},
                  {1.06 * r, h - (kCapitalFoot + 0.2) * r},
                  {1.06 * r, h - (kCapitalFoot + 0.05) * r},
                  {0.88 * r, h - kCapitalFoot * r},
                  {0.95 * r, h - 3.0 * r},
                  {1.20 * r, h - 1.7 * r},
                  {1.75 * r, h - 0.8 * r},
                  {1.60 * r, h - kAbacusFoot * r},
                  {1.95 * r, h - 0.6 * r},
                  {1.95 * r, h}},
                 false);
}

// Relative height of the carving on the shaft, about -1 to 0.
double computeCarving(ShaftStyle style, double angle, double y, double pitch) {
  switch (style) {
    case ShaftStyle::kFluted: {
      const double flute = std::cos(4.0 * angle);
      return -0.8 * (1.0 - flute * flute);
    }
    case ShaftStyle::kTwisted:
      return -1.1 * (0.5 - 0.5 * std::cos(4.0 * angle - pitch * y));
    case ShaftStyle::kDiamond: {
      const double a = std::cos(4.0 * angle + 1.3 * pitch * y);
      const double b = std::cos(4.0 * angle - 1.3 * pitch * y);
      return -0.5 * (1.0 - std::min(a, b));
    }
    case ShaftStyle::kBraided: {
      const double a = std::cos(2.0 * angle + pitch * y), b = std::cos(2.0 * angle - pitch * y);
      return 1.1 * (std::max(a, b) - 1.0);
    }
  }
  return 0.0;
}

// Relative height of two rows of leaves; up runs from 0 to 1 over the capital.
double computeLeaves(double angle, double up, int leaves) {
  const double lower = std::max(0.0, std::cos(leaves * angle)) * computeStep(0.0, 0.30, up) *
                       (1.0 - computeStep(0.44, 0.52, up));
  const double upper = std::max(0.0, -std::cos(leaves * angle)) * computeStep(0.35, 0.70, up) *
                       (1.0 - computeStep(0.80, 0.90, up));
  const double veins = 0.85 + 0.15 * std::cos(6.0 * leaves * angle);
  return veins * (lower + 1.2 * upper);
}

// Radius of a square with rounded corners against its inscribed circle; exponent 2 is a circle.
double computeSquareness(double angle, double exponent) {
  const double c = std::abs(std::cos(angle)), s = std::abs(std::sin(angle));
  return std::pow(std::pow(c, exponent) + std::pow(s, exponent), -1.0 / exponent);
}

}  // namespace

Body makeColumn(const ColumnSpec& spec, double detail) {
  Random random(spec.seed);
  const double sense = random.below(2) == 0 ? 1.0 : -1.0;
  const double pitch = sense * random.uniform(0.9, 1.4) / spec.radius;
  const int leaves = 4 * (1 + random.below(2));
  const double depth = random.uniform(0.20, 0.30);
  return makeTurned(
      makeColumnProfile(spec), detail,
      [=](const TurnedPoint& p) {
        const double r = spec.radius, down = (spec.height - p.y) / r;
        const double fromFoot = computeStep(kBaseTop + 0.3, kBaseTop + 1.2, p.y / r);
        const double fromTop = computeStep(kCapitalFoot + 0.6, kCapitalFoot + 1.5, down);
        double factor =
            1.0 + 0.24 * fromFoot * fromTop *
                      computeCarving(spec.style, p.angle, p.y - 0.4 * spec.height, pitch);
        const double up = 1.0 - (down - kAbacusFoot) / (kCapitalFoot - kAbacusFoot);
        if (up > 0.0 && up < 1.0) factor += depth * computeLeaves(p.angle, up, leaves);
        const double square =
            std::max(1.0 - computeStep(kPlinthTop - 0.1, kPlinthTop + 0.1, p.y / r),
                     computeStep(0.45, 1.0, up));
        factor *= computeSquareness(p.angle, 2.0 + 14.0 * square);
        return glm::dvec3(p.radius * factor * std::cos(p.angle), p.y,
                          p.radius * factor * std::sin(p.angle));
      },
      2.1);
}

}  // namespace hlodbench::courtyard
