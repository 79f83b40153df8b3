#include <cmath>

#include <fmt/format.h>

#include "hlod/scene/courtyard_exhibit.h"
#include "hlod/scene/courtyard_noise.h"
#include "hlod/scene/courtyard_palette.h"
#include "hlod/scene/courtyard_plan.h"
#include "hlod/scene/courtyard_plants.h"
#include "hlod/scene/courtyard_sculpture.h"
#include "hlod/scene/courtyard_shapes.h"
#include "hlod/scene/courtyard_vessels.h"

namespace hlodbench::courtyard {
namespace {

using Plans = std::vector<ObjectPlan>;

constexpr double kTreeDetail = 2.4;
constexpr double kHedgeDetail = 2.2;

void addFountain(Random& random, Plans& plans) {
  const Placement at{{0.0, 0.0, 0.0}, 0.0, 0.85};
  plans.push_back(
      movedObject({"fountain", pickColor(Material::kMarble, random), makeFountainStone(3.4)}, at));
  const glm::vec3 blue = pickColor(Material::kWater, random);
  plans.push_back(movedObject({"fountain water", blue, makeFountainWater(random.next(), 3.0)}, at));
}

// Worn round stones set about the fountain, in the gap between basin and beds.
void addStoneRing(Random& random, Plans& plans) {
  constexpr int kStones = 20;
  ObjectPlan ring{"stone ring", pickColor(Material::kPaving, random), {}};
  for (int i = 0; i < kStones; ++i) {
    const std::uint64_t seed = random.next();
    const double radius = random.uniform(0.20, 0.27), angle = kTau * i / kStones;
    const Body stone = makeSphere(radius, 2.6, [=](const glm::dvec3& d) {
      const double r = radius * (1.0 + 0.12 * computeFractalNoise(2.2 * d, 2, seed));
      return glm::dvec3(r * d.x, 0.30 * r * d.y, r * d.z);
    });
    ring.bodies.push_back(
        movedBody(stone, {{2.12 * std::cos(angle), 0.0, 2.12 * std::sin(angle)}}));
  }
  plans.push_back(std::move(ring));
}

Body makeLawn(double size, std::uint64_t seed) {
  const Body lawn = makeRoundedBox({size, 0.3, size}, 0.06, 1.1, [seed](const glm::dvec3& at) {
    return at.y < 0.0 ? 0.0 : 0.03 * computeFractalNoise({3.0 * at.x, 0.0, 3.0 * at.z}, 3, seed);
  });
  return movedBody(lawn, {{0.0, -0.08, 0.0}});
}

// One of the four beds; in its own frame it lies towards +x and +z.
void addBed(int quarter, Random& random, Plans& plans) {
  const std::string name = fmt::format("bed {}", quarter + 1);
  const Placement turn = makeSidePlacement(quarter);
  const auto at = [&turn, &random](double x, double z) {
    return Placement{turn.apply({x, 0.0, z}), turn.yaw + random.uniform(0.0, kTau)};
  };
  const auto add = [&](ObjectPlan plan) { plans.push_back(movedObject(std::move(plan), turn)); };

  const Body lawn = movedBody(makeLawn(5.1, random.next()), {{4.45, 0.0, 4.45}});
  add({name + " lawn", pickColor(Material::kSoil, random), {lawn}});
  const glm::vec3 hedgeColor = pickColor(Material::kLeaf, random);
  for (int h = 0; h < 2; ++h) {
    const glm::dvec3 size = h == 0 ? glm::dvec3(0.42, 0.8, 3.6) : glm::dvec3(3.6, 0.8, 0.42);
    const glm::dvec3 where = h == 0 ? glm::dvec3(2.2, 0.0, 4.9) : glm::dvec3(4.9, 0.0, 2.2);
    const Body hedge = movedBody(makeHedge(size, random.next(), kHedgeDetail), {where});
    add({fmt::format("{} hedge {}", name, h + 1), hedgeColor, {hedge}});
  }
  Tree tree = makeTree(random, kTreeDetail);
  const double dx = random.uniform(-0.2, 0.2), dz = random.uniform(-0.2, 0.2);
  const Placement spot = at(4.5 + dx, 4.5 + dz);
  plans.push_back(movedObject(
      {name + " tree", pickColor(Material::kBark, random), std::move(tree.wood)}, spot));
  plans.push_back(movedObject(
      {name + " crown", pickColor(Material::kLeaf, random), std::move(tree.crown)}, spot));
  add({name + " cypress",
       pickColor(Material::kLeaf, random),
       {movedBody(makeCypress(random, 2.6), {{6.4, 0.0, 6.4}})}});
  addPlanter(name + " planter", at(2.4, 2.4), random, plans);
  const int first = random.below(kSculptureKinds), second = random.below(kSculptureKinds);
  addSculpture(name + " sculpture 1", first, 0.8, at(3.2, 6.2), random, plans);
  addSculpture(name + " sculpture 2", second, 0.8, at(6.2, 3.2), random, plans);
}

}  // namespace

void planGarden(std::uint64_t seed, Plans& plans) {
  Random random(seed);
  addFountain(random, plans);
  addStoneRing(random, plans);
  for (int quarter = 0; quarter < 4; ++quarter) addBed(quarter, random, plans);
}

}  // namespace hlodbench::courtyard
