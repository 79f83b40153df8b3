#include "hlod/scene/courtyard_plants.h"

#include <cmath>

#include "hlod/scene/courtyard_noise.h"
#include "hlod/scene/courtyard_shapes.h"

namespace hlodbench::courtyard {
namespace {

// Height of a leafy surface, about -1 to 1: clumps with creases between them.
double computeFoliage(const glm::dvec3& point, std::uint64_t seed) {
  const double clump = 1.0 - 2.0 * std::abs(computeNoise(point, seed));
  return 0.6 * clump + 0.5 * computeFractalNoise(2.7 * point, 2, seed + 1);
}

Body makeBough(const glm::dvec3& from, const glm::dvec3& to, double thickness, std::uint64_t seed,
               double detail) {
  const glm::dvec3 middle = 0.5 * (from + to) + glm::dvec3(0.0, 0.25 * glm::length(to - from), 0.0);
  TubeSpec spec;
  spec.spine = [=](double s) {
    return (1 - s) * (1 - s) * from + 2.0 * s * (1 - s) * middle + s * s * to;
  };
  spec.radius = [=](double s, double angle) {
    const double bark = computeNoise({3.0 * std::cos(angle), 9.0 * s, 3.0 * std::sin(angle)}, seed);
    return thickness * (1.0 - 0.7 * s) * (1.0 + 0.14 * bark);
  };
  const glm::dvec3 flat = glm::normalize(glm::dvec3(to.x - from.x, 0.0, to.z - from.z));
  spec.side = {-flat.z, 0.0, flat.x};
  spec.length = glm::length(to - from) * 1.1;
  spec.thickness = 0.65 * thickness;
  return makeTube(spec, detail);
}

Body makeTrunk(double height, double lean, double direction, std::uint64_t seed, double detail) {
  const Profile profile(
      {{0.40, -0.05}, {0.30, 0.12}, {0.21, 0.45}, {0.17, 0.5 * height}, {0.12, height}}, true);
  return makeTurned(profile, detail, [=](const TurnedPoint& p) {
    const double foot = 1.0 - computeStep(0.0, 0.5, p.y);
    const double roots = 0.30 * foot * std::cos(5.0 * p.angle + 1.5);
    const double bark =
        0.10 * std::cos(11.0 * p.angle + 2.5 * p.y) +
        0.12 * computeNoise({4.0 * std::cos(p.angle), 3.0 * p.y, 4.0 * std::sin(p.angle)}, seed);
    const double r = p.radius * (1.0 + roots + bark);
    const double bend = lean * std::sin(1.3 * p.y);
    return glm::dvec3(bend * std::cos(direction) + r * std::cos(p.angle), p.y,
                      bend * std::sin(direction) + r * std::sin(p.angle));
  });
}

}  // namespace

Body makeBush(double radius, std::uint64_t seed, double detail) {
  return makeSphere(1.15 * radius, detail, [=](const glm::dvec3& d) {
    const double leaf = computeFoliage(d * (radius * 4.5) + 20.0, seed);
    return d * (radius * (1.0 + 0.12 * leaf / (0.4 + radius)));
  });
}

Tree makeTree(Random& random, double detail) {
  const double height = random.uniform(2.2, 2.7), lean = random.uniform(0.05, 0.16);
  const double direction = random.uniform(0.0, kTau);
  Tree tree;
  tree.wood.push_back(makeTrunk(height, lean, direction, random.next(), detail));
  const double bend = lean * std::sin(1.3 * height);
  const glm::dvec3 top(bend * std::cos(direction), height - 0.1, bend * std::sin(direction));
  const int boughs = 6;
  const double first = random.uniform(0.0, kTau);
  for (int i = 0; i < boughs; ++i) {
    const double angle = first + kTau * (i + random.uniform(-0.2, 0.2)) / boughs;
    const double out = random.uniform(0.75, 1.15), up = random.uniform(0.35, 1.3);
    const glm::dvec3 end = top + glm::dvec3(out * std::cos(angle), up, out * std::sin(angle));
    tree.wood.push_back(
        makeBough(top - glm::dvec3(0.0, 0.3, 0.0), end, 0.10, random.next(), detail));
    const double radius = random.uniform(0.62, 0.88);
    tree.crown.push_back(movedBody(makeBush(radius, random.next(), detail), {end}));
  }
  const glm::dvec3 crest = top + glm::dvec3(0.0, random.uniform(1.3, 1.7), 0.0);
  tree.crown.push_back(movedBody(makeBush(0.95, random.next(), detail), {crest}));
  return tree;
}

Body makeCypress(Random& random, double detail) {
  const double height = random.uniform(4.0, 5.0), width = random.uniform(0.42, 0.5);
  const std::uint64_t seed = random.next();
  const Profile profile({{0.12, 0.0},
                         {0.7 * width, 0.18},
                         {width, 0.25 * height},
                         {0.85 * width, 0.5 * height},
                         {0.5 * width, 0.78 * height},
                         {0.05, height}},
                        true);
  return makeTurned(profile, detail, [=](const TurnedPoint& p) {
    const glm::dvec3 at = p.position();
    const double leaf = computeFoliage({5.0 * at.x, 2.2 * at.y, 5.0 * at.z}, seed);
    const double r = p.radius * (1.0 + 0.16 * leaf);
    return glm::dvec3(r * std::cos(p.angle), p.y, r * std::sin(p.angle));
  });
}

Body makeHedge(const glm::dvec3& size, std::uint64_t seed, double detail) {
  const Body hedge = makeRoundedBox(size, 0.12, detail, [seed](const glm::dvec3& at) {
    return 0.045 * computeFoliage(5.0 * at + 40.0, seed);
  });
  return movedBody(hedge, {{0.0, 0.5 * size.y, 0.0}});
}

}  // namespace hlodbench::courtyard
