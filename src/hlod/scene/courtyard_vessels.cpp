#include "hlod/scene/courtyard_vessels.h"

#include <cmath>

#include "hlod/scene/courtyard_noise.h"
#include "hlod/scene/courtyard_shapes.h"

namespace hlodbench::courtyard {
namespace {

// The profile of a bowl with a scalloped rim: up the outside, over the lip and down inside.
Profile makeBowlProfile(double radius, double depth, double foot) {
  return Profile({{foot, 0.0},
                  {0.45 * radius, 0.18 * depth},
                  {0.82 * radius, 0.55 * depth},
                  {0.96 * radius, 0.92 * depth},
                  {1.00 * radius, 1.00 * depth},
                  {0.95 * radius, 1.02 * depth},
                  {0.88 * radius, 0.90 * depth},
                  {0.60 * radius, 0.52 * depth},
                  {0.20 * radius, 0.34 * depth}},
                 true);
}

Body makeScallopedBowl(double radius, double depth, double foot, int lobes, double detail) {
  return makeTurned(makeBowlProfile(radius, depth, foot), detail, [=](const TurnedPoint& p) {
    const double rim = computeStep(0.3, 1.0, p.radius / radius);
    const double wave = std::abs(std::cos(0.5 * lobes * p.angle));
    const double r = p.radius * (1.0 + 0.07 * rim * (wave - 0.5));
    return glm::dvec3(r * std::cos(p.angle), p.y + 0.05 * depth * rim * wave,
                      r * std::sin(p.angle));
  });
}

Body makeBasin(double detail) {
  const Profile profile({{2.05, 0.0},
                         {2.10, 0.08},
                         {1.98, 0.16},
                         {1.95, 0.44},
                         {2.04, 0.52},
                         {2.08, 0.60},
                         {1.86, 0.62},
                         {1.78, 0.54},
                         {1.76, 0.16},
                         {1.60, 0.12}},
                        false);
  return makeTurned(
      profile, detail,
      [](const TurnedPoint& p) {
        // An octagon; between its corners the outside carries upright ribs.
        const double sector = kTau / 8;
        const double within = p.angle - sector * std::round(p.angle / sector);
        const double octagon = std::cos(sector / 2) / std::cos(within) * 1.04;
        const double side = computeStep(0.14, 0.20, p.y) * (1.0 - computeStep(0.40, 0.46, p.y));
        const double outside = p.share < 0.5 ? 1.0 : 0.0;
        const double rib = 0.022 * outside * side * std::cos(64.0 * p.angle);
        const double ring = computeStep(0.5, 1.0, p.radius);
        const double r = p.radius * (1.0 + ring * (octagon - 1.0 + rib));
        return glm::dvec3(r * std::cos(p.angle), p.y, r * std::sin(p.angle));
      },
      1.4);
}

Body makeWaterDisc(double radius, double y, std::uint64_t seed, double detail) {
  const Profile profile({{radius, y - 0.06}, {radius, y}}, false);
  return makeTurned(profile, detail, [=](const TurnedPoint& p) {
    const double top = p.share > 0.5 ? 1.0 : 0.0;
    const double ripple =
        0.012 * std::cos(26.0 * p.radius) + 0.010 * computeNoise(5.0 * p.position(), seed);
    return p.position() + glm::dvec3(0.0, top * ripple, 0.0);
  });
}

// A jet that leaves a bowl's rim at (from, top) and falls outwards to (to, bottom).
Body makeJet(double from, double top, double to, double bottom, double turn, double detail) {
  TubeSpec spec;
  spec.spine = [=](double s) {
    const double out = from + (to - from) * s;
    return glm::dvec3(out * std::cos(turn), top + 0.06 * s - (top - bottom + 0.06) * s * s,
                      out * std::sin(turn));
  };
  spec.radius = [](double s, double angle) {
    return 0.018 + 0.008 * s + 0.006 * std::cos(40.0 * s + angle);
  };
  spec.side = {-std::sin(turn), 0.0, std::cos(turn)};
  spec.length = std::hypot(to - from, top - bottom);
  spec.thickness = 0.024;
  return makeTube(spec, detail);
}

}  // namespace

Body makeVase(Random& random, double detail) {
  const double height = random.uniform(0.75, 1.15), belly = random.uniform(0.24, 0.34);
  const double neck = random.uniform(0.35, 0.55) * belly, lip = random.uniform(0.55, 0.85) * belly;
  const double high = random.uniform(0.40, 0.62) * height;
  const Profile profile({{0.55 * belly, 0.0},
                         {0.50 * belly, 0.05 * height},
                         {0.80 * belly, 0.22 * height},
                         {belly, high},
                         {0.78 * belly, 0.76 * height},
                         {neck, 0.87 * height},
                         {lip, 0.99 * height},
                         {0.92 * lip, height},
                         {0.80 * neck, 0.88 * height},
                         {0.60 * belly, 0.72 * height},
                         {0.30 * belly, 0.60 * height}},
                        true);
  const int style = random.below(3), gadroons = 10 + 2 * random.below(6);
  const double twist = random.uniform(-5.0, 5.0);
  const std::uint64_t seed = random.next();
  return makeTurned(
      profile, detail,
      [=](const TurnedPoint& p) {
        const double body =
            computeStep(0.06, 0.16, p.share) * (1.0 - computeStep(0.42, 0.50, p.share));
        double carve = 0.05 * std::cos(gadroons * p.angle + (style == 1 ? twist * p.y : 0.0));
        if (style == 2) carve = 0.06 * computeNoise(11.0 * p.position(), seed);
        const double r = p.radius * (1.0 + body * carve);
        return glm::dvec3(r * std::cos(p.angle), p.y, r * std::sin(p.angle));
      },
      1.2);
}

Body makePlanter(Random& random, double detail) {
  const int lobes = 12 + 4 * random.below(4);
  const Profile profile({{0.24, 0.0},
                         {0.25, 0.05},
                         {0.12, 0.12},
                         {0.15, 0.18},
                         {0.32, 0.30},
                         {0.38, 0.44},
                         {0.43, 0.53},
                         {0.40, 0.56},
                         {0.36, 0.50},
                         {0.28, 0.44}},
                        true);
  return makeTurned(profile, detail, [lobes](const TurnedPoint& p) {
    const double body = computeStep(0.32, 0.42, p.share) * (1.0 - computeStep(0.55, 0.66, p.share));
    const double r = p.radius * (1.0 + 0.05 * body * std::cos(lobes * p.angle));
    return glm::dvec3(r * std::cos(p.angle), p.y, r * std::sin(p.angle));
  });
}

std::vector<Body> makeFountainStone(double detail) {
  const Profile stem({{0.42, 0.0},
                      {0.42, 0.30},
                      {0.30, 0.45},
                      {0.20, 0.70},
                      {0.24, 0.95},
                      {0.17, 1.20},
                      {0.20, 1.40},
                      {0.12, 1.75},
                      {0.15, 2.00},
                      {0.09, 2.30},
                      {0.12, 2.50},
                      {0.05, 2.62}},
                     true);
  std::vector<Body> bodies;
  bodies.push_back(makeBasin(0.8 * detail));
  bodies.push_back(makeTurned(stem, detail, [](const TurnedPoint& p) {
    const double r = p.radius * (1.0 + 0.07 * std::cos(8.0 * p.angle + 3.0 * p.y));
    return glm::dvec3(r * std::cos(p.angle), p.y, r * std::sin(p.angle));
  }));
  bodies.push_back(movedBody(makeScallopedBowl(1.05, 0.34, 0.18, 16, detail), {{0.0, 1.15, 0.0}}));
  bodies.push_back(movedBody(makeScallopedBowl(0.60, 0.24, 0.12, 12, detail), {{0.0, 2.0, 0.0}}));
  KnotSpec finial;
  finial.major = 0.17;
  finial.minor = 0.08;
  finial.thickness = 0.045;
  bodies.push_back(movedBody(makeKnot(finial, 1.3 * detail), {{0.0, 2.72, 0.0}}));
  return bodies;
}

std::vector<Body> makeFountainWater(std::uint64_t seed, double detail) {
  std::vector<Body> bodies;
  bodies.push_back(makeWaterDisc(1.80, 0.46, seed, 0.7 * detail));
  bodies.push_back(makeWaterDisc(0.88, 1.44, seed + 1, 0.8 * detail));
  bodies.push_back(makeWaterDisc(0.48, 2.20, seed + 2, 0.8 * detail));
  for (int i = 0; i < 8; ++i) {
    bodies.push_back(makeJet(1.02, 1.50, 1.45, 0.44, kTau * (i + 0.5) / 8, detail));
    if (i % 2 == 0) bodies.push_back(makeJet(0.58, 2.25, 0.80, 1.42, kTau * i / 8, detail));
  }
  return bodies;
}

}  // namespace hlodbench::courtyard
