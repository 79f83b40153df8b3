#include <utility>

#include <fmt/format.h>

#include "hlod/scene/courtyard_exhibit.h"
#include "hlod/scene/courtyard_noise.h"
#include "hlod/scene/courtyard_palette.h"
#include "hlod/scene/courtyard_plan.h"
#include "hlod/scene/courtyard_plants.h"
#include "hlod/scene/courtyard_sculpture.h"
#include "hlod/scene/courtyard_shapes.h"

namespace hlodbench::courtyard {
namespace {

using Plans = std::vector<ObjectPlan>;

// Compilers differ in the order of a call's arguments, so no call here draws two random numbers in
// its arguments.

// Places things in a side's frame (x along the wall, z outwards), facing the middle but for a
// small random turn.
class SidePlacer {
 public:
  SidePlacer(int side, Random& random) : turn_(makeSidePlacement(side)), random_(random) {}

  Placement operator()(double x, double z, double scale = 1.0) {
    const double dx = random_.uniform(-0.06, 0.06), dz = random_.uniform(-0.06, 0.06);
    const glm::dvec3 at(x + dx, 0.0, z + dz);
    return {turn_.apply(at), turn_.yaw + kPi + random_.uniform(-0.5, 0.5), scale};
  }

 private:
  Placement turn_;
  Random& random_;
};

void addBench(const std::string& name, const Placement& at, Random& random, Plans& plans) {
  const std::uint64_t seed = random.next();
  const auto worn = [seed](const glm::dvec3& p) {
    return 0.015 * computeFractalNoise(4.0 * p, 2, seed);
  };
  ObjectPlan bench{name, pickColor(Material::kColumn, random), {}};
  bench.bodies.push_back(
      movedBody(makeRoundedBox({1.5, 0.12, 0.44}, 0.04, 2.0, worn), {{0.0, 0.42, 0.0}}));
  for (const double x : {-0.55, 0.55}) {
    bench.bodies.push_back(
        movedBody(makeRoundedBox({0.16, 0.42, 0.36}, 0.03, 2.0, worn), {{x, 0.18, 0.0}}));
  }
  plans.push_back(movedObject(std::move(bench), at));
}

// Along the hall wall, between its doors and windows, so that columns stand before them.
void planAmbulatory(int side, Random& random, Plans& plans) {
  const std::string name = fmt::format("ambulatory {}", nameSide(side));
  SidePlacer place(side, random);
  constexpr double kLine = kHallWall - 0.85;
  int number = 0;
  for (const double x : {-10.6, -3.93, 3.93}) {
    // The middle one is always a figure: each side has one, and visitors can count on it.
    const int lot = random.below(kSculptureKinds);
    const int kind = x == -3.93 ? 0 : lot;
    addSculpture(fmt::format("{} sculpture {}", name, ++number), kind, 0.7, place(x, kLine), random,
                 plans);
  }
  addVase(name + " vase 1", place(-1.7, kLine + 0.1), random, plans);
  addVase(name + " vase 2", place(1.7, kLine + 0.1), random, plans);
  const Placement turn = makeSidePlacement(side);
  for (const double x : {-5.6, 5.6}) {
    addBench(fmt::format("{} bench {}", name, x < 0 ? 1 : 2),
             {turn.apply({x, 0.0, kHallWall - 0.6}), turn.yaw}, random, plans);
  }
}

// The two long chambers of a side, left and right of the middle one: a row along the outer wall
// and a vase on either side of the door; the line between the partitions' doors stays free.
void planLongChamber(int side, double middle, Random& random, Plans& plans) {
  const std::string name =
      fmt::format("chamber {} {}", nameSide(side), middle < 0 ? "left" : "right");
  SidePlacer place(side, random);
  int number = 0;
  for (const double x : {-2.8, -0.95, 0.95, 2.8}) {
    addExhibit(fmt::format("{} exhibit {}", name, ++number), place(middle + x, 14.85), random,
               plans);
  }
  addVase(name + " vase 1", place(middle - 2.6, 12.3), random, plans);
  addVase(name + " vase 2", place(middle + 2.6, 12.3), random, plans);
}

// The middle chamber; the south one is the vestibule behind the gate and keeps its axis free.
void planMiddleChamber(int side, Random& random, Plans& plans) {
  const std::string name = fmt::format("chamber {} middle", nameSide(side));
  SidePlacer place(side, random);
  int number = 0;
  for (const double x : {-2.7, 2.7}) {
    addExhibit(fmt::format("{} exhibit {}", name, ++number), place(x, 14.8), random, plans);
    addVase(fmt::format("{} vase {}", name, number), place(1.05 * x, 12.3), random, plans);
  }
  if (side != 0) {
    const int kind = 1 + random.below(kSculptureKinds - 1);
    addSculpture(name + " centrepiece", kind, 0.6, place(0.0, 14.6, 1.35), random, plans);
  }
}

// The corner chamber between a side and the next one.
void planCornerChamber(int side, Random& random, Plans& plans) {
  const std::string name = fmt::format("chamber corner {}", side + 1);
  SidePlacer place(side, random);
  const int kind = random.below(kSculptureKinds);
  addSculpture(name + " centrepiece", kind, 0.6, place(14.3, 14.3, 1.45), random, plans);
  addVase(name + " vase 1", place(15.1, 12.4), random, plans);
  addVase(name + " vase 2", place(12.4, 15.1), random, plans);
  addPlanter(name + " planter", place(12.3, 12.3, 0.9), random, plans);
}

void planForecourt(Random& random, Plans& plans) {
  SidePlacer place(0, random);
  for (const double x : {-2.4, 2.4}) {
    const char* side = x < 0 ? "left" : "right";
    ObjectPlan cypress{
        fmt::format("gate cypress {}", side), pickColor(Material::kLeaf, random), {}};
    cypress.bodies.push_back(makeCypress(random, 2.6));
    plans.push_back(movedObject(std::move(cypress), place(1.6 * x, 17.6)));
    addPlanter(fmt::format("gate planter {}", side), place(x, 17.0), random, plans);
  }
}

}  // namespace

void planHalls(std::uint64_t seed, Plans& plans) {
  Random random(seed);
  planForecourt(random, plans);
  for (int side = 0; side < 4; ++side) {
    planAmbulatory(side, random, plans);
    planMiddleChamber(side, random, plans);
    planLongChamber(side, -7.75, random, plans);
    planLongChamber(side, 7.75, random, plans);
    planCornerChamber(side, random, plans);
  }
}

}  // namespace hlodbench::courtyard
