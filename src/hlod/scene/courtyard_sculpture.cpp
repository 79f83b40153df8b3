#include "hlod/scene/courtyard_sculpture.h"

#include <algorithm>
#include <cmath>

#include "hlod/scene/courtyard_noise.h"
#include "hlod/scene/courtyard_shapes.h"

namespace hlodbench::courtyard {
namespace {

constexpr double kDetail = 5.6;  // cells per cell of a plain wall

// Gielis' superformula with equal second and third exponents, scaled so that it reaches 1 and no
// further; bulge >= 2.
struct Superformula {
  double lobes, roundness, bulge;
  [[nodiscard]] double radius(double angle) const {
    const double c = std::pow(std::abs(std::cos(lobes * angle / 4)), bulge);
    const double s = std::pow(std::abs(std::sin(lobes * angle / 4)), bulge);
    const double least = std::pow(2.0, 1.0 - bulge / 2);
    return std::pow((c + s) / least, -1.0 / roundness);
  }
};

// Puts a body that is centred on the origin upright over y = 0, its lowest point at `height`.
Body raised(Body body, double height) {
  return movedBody(std::move(body), {{0.0, height, 0.0}});
}

}  // namespace

Body makePedestal(double width, double height, double detail) {
  const double w = 0.5 * width;
  const Profile profile({{w, 0.0},
                         {w, 0.14 * height},
                         {0.92 * w, 0.17 * height},
                         {0.80 * w, 0.22 * height},
                         {0.78 * w, 0.80 * height},
                         {0.84 * w, 0.85 * height},
                         {0.98 * w, 0.88 * height},
                         {0.98 * w, height}},
                        false);
  return makeTurned(profile, detail, [](const TurnedPoint& p) {
    const double c = std::abs(std::cos(p.angle)), s = std::abs(std::sin(p.angle));
    const double square = std::pow(std::pow(c, 14.0) + std::pow(s, 14.0), -1.0 / 14.0);
    return glm::dvec3(p.radius * square * std::cos(p.angle), p.y,
                      p.radius * square * std::sin(p.angle));
  });
}

std::vector<Body> makeKnotwork(Random& random) {
  static constexpr int kTypes[][2] = {{2, 3}, {3, 2}, {2, 5}, {3, 4}};
  const auto& type = kTypes[random.below(4)];
  KnotSpec spec;
  spec.turns = type[0];
  spec.windings = type[1];
  spec.major = 0.34;
  spec.minor = 0.17;
  spec.thickness = spec.turns == 2 ? 0.085 : 0.065;
  const int beads = 8 * (3 + random.below(3));
  const int lobes = 3 + random.below(3);
  spec.radius = [thickness = spec.thickness, beads, lobes](double t, double angle) {
    const double twist = std::cos(lobes * angle + kTau * beads * t);
    return thickness * (1.0 + 0.14 * twist);
  };
  const Body flat = makeKnot(spec, kDetail);
  // Stood on its edge: x stays, y and z trade places with a sign that keeps the winding.
  const double lift = spec.major + spec.minor + spec.thickness;
  Body upright{flat.lattice, [place = flat.place, lift](const Lattice& l, const glm::ivec3& v) {
                 const glm::dvec3 p = place(l, v);
                 return glm::dvec3(p.x, lift + p.z, -p.y);
               }};
  return {upright};
}

std::vector<Body> makeSupershape(Random& random) {
  const Superformula around{static_cast<double>(4 * (2 + random.below(3))),
                            random.uniform(1.5, 2.6), random.uniform(3.5, 6.0)};
  const Superformula up{4.0, random.uniform(4.0, 7.0), random.uniform(2.5, 4.0)};
  const double twist = random.uniform(-2.2, 2.2);
  const double size = 0.48;
  return {raised(makeSphere(1.3 * size, kDetail,
                            [=](const glm::dvec3& d) {
                              const double latitude = std::asin(glm::clamp(d.y, -1.0, 1.0));
                              const double longitude = std::atan2(d.z, d.x) + twist * d.y;
                              const double r2 = up.radius(latitude);
                              const double flat = std::hypot(d.x, d.z);
                              const double r1 = glm::mix(1.0, around.radius(longitude),
                                                         computeStep(0.02, 0.5, flat));
                              const double r = size * r1 * r2;
                              return glm::dvec3(r * d.x, 1.5 * size * r2 * d.y, r * d.z);
                            }),
                 1.45 * size)};
}

std::vector<Body> makeCoral(Random& random) {
  const std::uint64_t seed = random.next();
  const double frequency = random.uniform(3.5, 6.0), height = random.uniform(0.22, 0.36);
  const double size = 0.38;
  return {raised(makeSphere(1.5 * size, kDetail,
                            [=](const glm::dvec3& d) {
                              const double ridge =
                                  1.0 - std::abs(computeNoise(frequency * d, seed));
                              const double fine = computeFractalNoise(9.0 * d, 2, seed + 9);
                              const double r =
                                  size * (0.85 + height * ridge * ridge * ridge + 0.04 * fine);
                              return glm::dvec3(r * d.x, 1.15 * r * d.y, r * d.z);
                            }),
                 1.1 * size)};
}

std::vector<Body> makeShell(Random& random) {
  const double turns = random.uniform(3.0, 3.8), growth = random.uniform(2.4, 3.0);
  const int ribs = 17 + random.below(8);
  const double scale = 0.30, least = std::exp(-growth);
  // A logarithmic spiral whose size, and so its length, grows evenly with the tube's parameter.
  const auto size = [least](double s) { return least + (1.0 - least) * s; };
  const auto turned = [growth, size](double s) { return 1.0 + std::log(size(s)) / growth; };
  TubeSpec spec;
  spec.spine = [=](double s) {
    const double r = scale * size(s), angle = kTau * turns * turned(s);
    return glm::dvec3(r * std::cos(angle), 3.1 * scale - 2.2 * r, r * std::sin(angle));
  };
  spec.radius = [=](double s, double angle) {
    const double rib = 0.5 + 0.5 * std::cos(kTau * ribs * turned(s));
    return scale * size(s) * (0.86 + 0.07 * rib + 0.05 * std::cos(9.0 * angle));
  };
  spec.side = {0.0, 1.0, 0.0};
  spec.length = kTau * turns * scale * 0.55;
  spec.thickness = 0.55 * scale;
  return {makeTube(spec, kDetail * 1.3)};
}

std::vector<Body> makeFlame(Random& random) {
  const int lobes = 3 + random.below(4);
  const double sense = random.below(2) == 0 ? 1.0 : -1.0;
  const double twist = sense * random.uniform(2.0, 4.5);
  const double depth = random.uniform(0.18, 0.32);
  const std::uint64_t seed = random.next();
  const Profile profile({{0.20, 0.0},
                         {0.30, 0.12},
                         {0.36, 0.40},
                         {0.30, 0.75},
                         {0.18, 1.10},
                         {0.09, 1.40},
                         {0.02, 1.62}},
                        true);
  return {makeTurned(profile, kDetail, [=](const TurnedPoint& p) {
    const double lobe = std::cos(lobes * p.angle + twist * p.y);
    const double fine = computeFractalNoise(6.0 * p.position(), 2, seed);
    const double grow = computeStep(0.0, 0.2, p.share);
    const double r = p.radius * (1.0 + grow * (depth * lobe + 0.05 * fine));
    const double sway = 0.06 * std::sin(2.2 * p.y) * grow;
    return glm::dvec3(sway + r * std::cos(p.angle), p.y, r * std::sin(p.angle));
  })};
}

std::vector<Body> makeSculpture(int kind, Random& random) {
  switch (kind) {
    case 0:
      return makeFigure(random);
    case 1:
      return makeKnotwork(random);
    case 2:
      return makeSupershape(random);
    case 3:
      return makeCoral(random);
    case 4:
      return makeShell(random);
    default:
      return makeFlame(random);
  }
}

}  // namespace hlodbench::courtyard
