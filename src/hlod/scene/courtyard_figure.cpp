#include <algorithm>
#include <cmath>

#include "hlod/scene/courtyard_noise.h"
#include "hlod/scene/courtyard_sculpture.h"
#include "hlod/scene/courtyard_shapes.h"

namespace hlodbench::courtyard {
namespace {

constexpr double kDetail = 5.6;

// The stance: how far the body's axis swings sideways at a height.
struct Stance {
  double sway;
  [[nodiscard]] double shift(double y) const { return sway * std::sin(4.2 * y); }
};

Body makeRobe(const Stance& stance, Random& random) {
  const Profile profile({{0.29, 0.0},
                         {0.285, 0.06},
                         {0.25, 0.35},
                         {0.225, 0.70},
                         {0.185, 1.02},
                         {0.20, 1.20},
                         {0.215, 1.34},
                         {0.17, 1.44},
                         {0.075, 1.49},
                         {0.06, 1.58}},
                        true);
  const int folds = 4 + random.below(3);  // a whole number of creases in half a turn
  const double swirl = random.uniform(-1.8, 1.8);
  const std::uint64_t seed = random.next();
  return makeTurned(
      profile, 1.3 * kDetail,
      [=](const TurnedPoint& p) {
        const double low = 1.0 - computeStep(0.2, 1.1, p.y);
        const double cloth = 1.0 - computeStep(1.30, 1.45, p.y);
        const double wave =
            computeNoise({1.5 * std::cos(p.angle), 1.6 * p.y, 1.5 * std::sin(p.angle)}, seed);
        const double crease =
            1.0 - std::abs(std::sin(folds * (p.angle + swirl * p.y) + 1.4 * wave * cloth));
        const double fold = crease - 0.4;
        const double r = p.radius * (1.0 + cloth * ((0.09 + 0.10 * low) * fold + 0.06 * wave));
        const double wide = 1.0 + 0.28 * computeStep(1.0, 1.3, p.y) * cloth;
        return glm::dvec3(stance.shift(p.y) + r * wide * std::cos(p.angle), p.y,
                          0.82 * r * std::sin(p.angle));
      },
      1.3);
}

Body makeHead(const Stance& stance, Random& random) {
  const std::uint64_t seed = random.next();
  const double turn = random.uniform(-0.6, 0.6);
  const Body head = makeSphere(0.14, kDetail * 2.6, [seed](const glm::dvec3& d) {
    const double nose = std::exp(-90.0 * (d.x * d.x + (d.y + 0.05) * (d.y + 0.05)));
    const double brow = std::exp(-60.0 * (d.y - 0.22) * (d.y - 0.22)) * std::exp(-6.0 * d.x * d.x);
    const double eyes = std::exp(
        -70.0 * ((std::abs(d.x) - 0.33) * (std::abs(d.x) - 0.33) + (d.y - 0.08) * (d.y - 0.08)));
    const double lips =
        std::exp(-160.0 * (d.y + 0.42) * (d.y + 0.42)) * std::exp(-20.0 * d.x * d.x);
    const double face =
        computeStep(0.35, 0.7, d.z) * (0.24 * nose + 0.05 * brow - 0.07 * eyes + 0.06 * lips);
    const double hair = 1.0 - computeStep(0.10, 0.34, d.z - 0.55 * d.y);
    const double locks = 0.5 + 0.5 * std::sin(16.0 * d.y + 5.0 * computeNoise(3.0 * d, seed));
    const double r = 0.105 * (1.0 + face + hair * (0.10 + 0.06 * locks));
    return glm::dvec3(0.86 * r * d.x, 1.2 * r * d.y, r * d.z);
  });
  return movedBody(head, {{stance.shift(1.68), 1.67, 0.02}, turn});
}

// One arm, bent at the elbow; `sign` is -1 or 1 for the side, reach in [0, 1] how far it is raised.
Body makeArm(const Stance& stance, double sign, double reach) {
  const glm::dvec3 shoulder(stance.shift(1.34) + sign * 0.235, 1.35, 0.0);
  const glm::dvec3 elbow(shoulder.x + sign * 0.09, 1.06 + 0.05 * reach, 0.04);
  const glm::dvec3 hand(shoulder.x - sign * 0.08, 0.98 + 0.35 * reach, 0.30);
  TubeSpec spec;
  spec.spine = [=](double s) {
    const glm::dvec3 bend = 1.45 * elbow - 0.225 * (shoulder + hand);
    return (1 - s) * (1 - s) * shoulder + 2.0 * s * (1 - s) * bend + s * s * hand;
  };
  spec.radius = [](double s, double angle) {
    const double sleeve = 1.0 - computeStep(0.62, 0.70, s);
    const double round = std::sqrt(std::max(0.04, 1.0 - std::pow(std::abs(2.0 * s - 1.0), 9.0)));
    return round * (0.042 + sleeve * (0.030 + 0.008 * std::cos(5.0 * angle + 14.0 * s)) +
                    0.012 * std::sin(kPi * s));
  };
  spec.side = {1.0, 0.0, 0.0};
  spec.length = 0.75;
  spec.thickness = 0.065;
  return makeTube(spec, kDetail);
}

// What the figure holds: an orb, a knot or a small flask.
Body makeAttribute(const glm::dvec3& at, Random& random) {
  const int kind = random.below(3);
  if (kind == 0) {
    return movedBody(makeSphere(0.10, kDetail,
                                [](const glm::dvec3& d) {
                                  const double ring = std::exp(-60.0 * d.y * d.y);
                                  return d * (0.09 + 0.012 * ring);
                                }),
                     {at});
  }
  if (kind == 1) {
    KnotSpec knot;
    knot.major = 0.08;
    knot.minor = 0.035;
    knot.thickness = 0.02;
    return movedBody(makeKnot(knot, kDetail), {at});
  }
  const Profile flask({{0.035, -0.12}, {0.08, -0.06}, {0.085, 0.0}, {0.03, 0.09}, {0.045, 0.15}},
                      true);
  return movedBody(makeTurned(flask, kDetail), {at});
}

}  // namespace

std::vector<Body> makeFigure(Random& random) {
  const Stance stance{random.uniform(-0.05, 0.05)};
  const double left = random.uniform(0.0, 1.0), right = random.uniform(0.0, 1.0);
  std::vector<Body> bodies;
  bodies.push_back(makeRobe(stance, random));
  bodies.push_back(makeHead(stance, random));
  bodies.push_back(makeArm(stance, -1.0, left));
  bodies.push_back(makeArm(stance, 1.0, right));
  const glm::dvec3 hand(stance.shift(1.34) + 0.13, 1.02 + 0.35 * right, 0.36);
  bodies.push_back(makeAttribute(hand, random));
  return bodies;
}

}  // namespace hlodbench::courtyard
