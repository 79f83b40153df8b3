#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "hlod/scene/courtyard_column.h"
#include "hlod/scene/courtyard_noise.h"
#include "hlod/scene/courtyard_palette.h"
#include "hlod/scene/courtyard_plan.h"
#include "hlod/scene/courtyard_shapes.h"
#include "hlod/scene/courtyard_wall.h"

namespace hlodbench::courtyard {
namespace {

using Kind = WallBay::Kind;
using Plans = std::vector<ObjectPlan>;

constexpr double kParapet = 0.45;    // height of the low wall that carries the columns
constexpr double kCapital = 2.5;     // height of the capitals' tops, where the arcade begins
constexpr double kTwinOffset = 0.2;  // of the two columns of a pair from the colonnade's line
constexpr double kWallDetail = 1.2;
constexpr double kColumnDetail = 4.6;

void addOuterWall(int side, Random& random, Plans& plans) {
  WallSpec spec;
  const WallBay centre =
      side == 0 ? WallBay{5.0, Kind::kDoor, 1.3} : WallBay{5.0, Kind::kWindow, 0.8};
  const WallBay window{2.4, Kind::kWindow, 0.6}, plain{5.5, Kind::kBlank, 0.0};
  const WallBay end{5.9, Kind::kBlank, 0.0};
  spec.bays = {end, window, plain, centre, plain, window, end};
  spec.thickness = 0.6;
  spec.sill = 1.5;
  spec.spring = 2.6;
  spec.top = 4.6;
  spec.seed = random.next();
  plans.push_back(movedObject({fmt::format("outer wall {}", nameSide(side)),
                               pickColor(Material::kWall, random),
                               {movedBody(makeWall(spec, kWallDetail), {{0.0, 0.0, kOuterWall}})}},
                              makeSidePlacement(side)));
}

void addHallWall(int side, Random& random, Plans& plans) {
  WallSpec spec;
  const WallBay window{1.75, Kind::kWindow, 0.5}, plain{1.75, Kind::kBlank, 0.0};
  const WallBay door{2.4, Kind::kDoor, 0.75}, middle{2.6, Kind::kDoor, 0.9};
  const WallBay end{2.9, Kind::kBlank, 0.0};
  spec.bays = {end, door, window, plain, window, middle, window, plain, window, door, end};
  spec.thickness = 0.5;
  spec.sill = 1.0;
  spec.spring = 2.05;
  spec.top = 5.0;
  spec.pointed = 0.4;
  spec.seed = random.next();
  plans.push_back(movedObject({fmt::format("hall wall {}", nameSide(side)),
                               pickColor(Material::kWall, random),
                               {movedBody(makeWall(spec, kWallDetail), {{0.0, 0.0, kHallWall}})}},
                              makeSidePlacement(side)));
}

// The walls between a side's chambers, with doors in one line along the hall wall.
void addPartitions(int side, Random& random, Plans& plans) {
  int number = 0;
  for (const double x : {-kHallWall, -3.9, 3.9, kHallWall}) {
    WallSpec spec;
    spec.bays = {{2.3, Kind::kBlank, 0.0}, {1.6, Kind::kDoor, 0.6}, {0.6, Kind::kBlank, 0.0}};
    spec.thickness = 0.4;
    spec.sill = spec.bottom;
    spec.spring = 1.95;
    spec.top = 3.9;
    spec.seed = random.next();
    // Its own x axis turned to point from the outer wall to the hall wall.
    const Placement across{{x, 0.0, 0.5 * (kHallWall + kOuterWall) + 0.05}, kPi / 2};
    plans.push_back(movedObject({fmt::format("partition {} {}", nameSide(side), ++number),
                                 pickColor(Material::kWall, random),
                                 {movedBody(makeWall(spec, kWallDetail), across)}},
                                makeSidePlacement(side)));
  }
}

void addArcade(int side, Random& random, Plans& plans) {
  WallSpec spec;
  spec.bays.assign(7, {kBayWidth, Kind::kDoor, 0.92});
  spec.thickness = 0.62;
  spec.bottom = spec.sill = kCapital;
  spec.spring = kCapital + 0.2;
  spec.top = 4.3;
  spec.pointed = 0.2;
  spec.blockLength = 0.9;
  spec.courseHeight = 0.45;
  spec.relief = 0.04;
  spec.seed = random.next();
  plans.push_back(
      movedObject({fmt::format("arcade {}", nameSide(side)),
                   pickColor(Material::kWall, random),
                   {movedBody(makeWall(spec, 1.5 * kWallDetail), {{0.0, 0.0, kColonnade}})}},
                  makeSidePlacement(side)));
}

// Low walls under the columns, open in the middle bay.
void addParapet(int side, Random& random, Plans& plans) {
  ObjectPlan parapet{
      fmt::format("parapet {}", nameSide(side)), pickColor(Material::kWall, random), {}};
  constexpr double kFirst = 0.85;
  const double length = kColonnade - kFirst;
  for (const double sign : {-1.0, 1.0}) {
    const std::uint64_t seed = random.next();
    const Body body = makeRoundedBox(
        {length, kParapet, 0.8}, 0.05, 1.3 * kWallDetail,
        [seed](const glm::dvec3& at) { return 0.02 * computeFractalNoise(2.5 * at, 2, seed); });
    parapet.bodies.push_back(
        movedBody(body, {{sign * (kFirst + 0.5 * length), 0.5 * kParapet - 0.03, kColonnade}}));
  }
  plans.push_back(movedObject(std::move(parapet), makeSidePlacement(side)));
}

void addColumns(int side, Random& random, Plans& plans) {
  int number = 0;
  for (const double x : {-2.5, -1.5, -0.5, 0.5, 1.5, 2.5}) {
    const glm::vec3 color = pickColor(Material::kColumn, random);
    const auto style = static_cast<ShaftStyle>(random.below(kShaftStyles));
    ++number;
    for (const double offset : {-kTwinOffset, kTwinOffset}) {
      ColumnSpec spec;
      spec.height = kCapital - kParapet + 0.05;
      spec.style = style;
      spec.seed = random.next();
      const Placement at{{x * kBayWidth, kParapet - 0.04, kColonnade + offset}};
      plans.push_back(movedObject(
          {fmt::format("column {} {}{}", nameSide(side), number, offset < 0 ? "a" : "b"),
           color,
           {movedBody(makeColumn(spec, kColumnDetail), at)}},
          makeSidePlacement(side)));
    }
  }
}

// A square pier at a corner of the square with half side `at`, where two walls meet.
void addCornerPier(const char* name, int side, double at, double width, double height,
                   Random& random, Plans& plans) {
  WallSpec spec;
  spec.bays = {{width, Kind::kBlank, 0.0}};
  spec.thickness = width;
  spec.sill = spec.bottom;
  spec.top = height;
  spec.blockLength = width;
  spec.courseHeight = 0.5;
  spec.relief = 0.05;
  spec.seed = random.next();
  plans.push_back(movedObject({fmt::format("{} {}", name, nameSide(side)),
                               pickColor(Material::kWall, random),
                               {movedBody(makeWall(spec, 1.5 * kWallDetail), {{at, 0.0, at}})}},
                              makeSidePlacement(side)));
}

// The lean-to roof over the ambulatory: a tiled slab, mitred at the corners.
void addRoof(int side, Random& random, Plans& plans) {
  constexpr double kEaves = kColonnade - 0.5, kRidge = kHallWall - 0.1, kThickness = 0.16;
  const double depth = kRidge - kEaves;
  const Body roof = makeBox({kRidge + kEaves, kThickness, depth}, 1.25, [=](const glm::dvec3& p) {
    const double out = p.z / depth + 0.5;  // 0 at the eaves, 1 at the ridge
    const double z = kEaves + out * depth;
    const double x = p.x / (0.5 * (kRidge + kEaves)) * z;
    const double row = out * 9.0 - std::floor(out * 9.0);
    const double edge = computeStep(0.0, 0.03, out) * (1.0 - computeStep(0.97, 1.0, out));
    const double tile = std::abs(std::cos(kPi * x / 0.42)) - 0.4 * row;
    const double up = p.y > 0.0 ? 0.07 * tile * edge : 0.0;
    return glm::dvec3(x, 4.28 + 0.85 * out + p.y + up, z);
  });
  const Placement turn = makeSidePlacement(side);
  plans.push_back(movedObject(
      {fmt::format("roof {}", nameSide(side)), pickColor(Material::kRoof, random), {roof}}, turn));
}

// Rafters under the roof and beams over the open chambers.
void addTimber(int side, Random& random, Plans& plans) {
  const auto makeBeam = [&random](double length, double width, double height) {
    const std::uint64_t seed = random.next();
    return makeRoundedBox({width, height, length}, 0.04, 1.6, [seed](const glm::dvec3& at) {
      return 0.018 * computeFractalNoise({5.0 * at.x, 5.0 * at.y, 1.2 * at.z}, 2, seed);
    });
  };
  ObjectPlan rafters{
      fmt::format("rafters {}", nameSide(side)), pickColor(Material::kTimber, random), {}};
  for (int i = -3; i <= 3; ++i) {
    rafters.bodies.push_back(movedBody(makeBeam(kHallWall - kColonnade, 0.18, 0.24),
                                       {{i * kBayWidth, 4.05, 0.5 * (kHallWall + kColonnade)}}));
  }
  plans.push_back(movedObject(std::move(rafters), makeSidePlacement(side)));
  ObjectPlan beams{
      fmt::format("beams {}", nameSide(side)), pickColor(Material::kTimber, random), {}};
  for (int i = -5; i <= 5; ++i) {
    beams.bodies.push_back(movedBody(makeBeam(kOuterWall - kHallWall + 0.3, 0.2, 0.26),
                                     {{i * 2.05, 4.1, 0.5 * (kOuterWall + kHallWall)}}));
  }
  plans.push_back(movedObject(std::move(beams), makeSidePlacement(side)));
}

// A slab of rough paving whose top is y = 0 between the joints.
void addFloor(const std::string& name, const glm::dvec2& centre, const glm::dvec2& size,
              Random& random, Plans& plans) {
  constexpr double kThickness = 0.35;
  const std::uint64_t seed = random.next();
  const Body floor = makeBox({size.x, kThickness, size.y}, 0.75, [=](const glm::dvec3& p) {
    const double x = p.x + centre.x, z = p.z + centre.y;
    const double pave = std::min(computeMasonry(x, z, 1.6, 1.2, seed), 1.0);
    const double wear = computeFractalNoise({0.7 * x, 0.0, 0.7 * z}, 3, seed);
    const double relief = p.y > 0.0 ? 0.05 * (pave - 1.0) + 0.01 * wear : 0.0;
    return glm::dvec3(x, p.y - 0.5 * kThickness + relief, z);
  });
  plans.push_back({name, pickColor(Material::kPaving, random), {floor}});
}

// Rows of separate flagstones, each a little tilted, over a rectangle of a side's frame.
void addFlagstones(const std::string& name, int side, const glm::dvec2& centre,
                   const glm::dvec2& size, Random& random, Plans& plans) {
  constexpr double kStone = 1.05, kJoint = 0.05, kTop = 0.045;
  const int across = computeCells(size.x, 1.0 / kStone, 1);
  const int along = computeCells(size.y, 1.0 / kStone, 1);
  const glm::dvec2 step = size / glm::dvec2(across, along);
  ObjectPlan stones{name, pickColor(Material::kPaving, random), {}};
  for (int i = 0; i < across * along; ++i) {
    const glm::dvec2 at = centre - 0.5 * size + step * (glm::dvec2(i % across, i / across) + 0.5);
    const double tiltX = random.uniform(-0.012, 0.012), tiltZ = random.uniform(-0.012, 0.012);
    const std::uint64_t seed = random.next();
    const glm::dvec3 block(step.x - kJoint, 0.12, step.y - kJoint);
    Body stone = makeRoundedBox(block, 0.03, 1.25, [=](const glm::dvec3& p) {
      const double worn = 0.012 * computeFractalNoise(2.2 * p, 2, seed);
      return worn + (p.y > 0.0 ? tiltX * p.x + tiltZ * p.z : 0.0);
    });
    stones.bodies.push_back(movedBody(std::move(stone), {{at.x, kTop - 0.06, at.y}}));
  }
  plans.push_back(movedObject(std::move(stones), makeSidePlacement(side)));
}

void addFloors(Random& random, Plans& plans) {
  constexpr double kEdge = kOuterWall + 0.4;
  const double depth = kEdge - kColonnade, middle = 0.5 * (kEdge + kColonnade);
  addFloor("garden ground", {0.0, 0.0}, {2 * kColonnade, 2 * kColonnade}, random, plans);
  addFloor("floor south", {0.0, middle}, {2 * kEdge, depth}, random, plans);
  addFloor("floor east", {middle, 0.0}, {depth, 2 * kColonnade}, random, plans);
  addFloor("floor north", {0.0, -middle}, {2 * kEdge, depth}, random, plans);
  addFloor("floor west", {-middle, 0.0}, {depth, 2 * kColonnade}, random, plans);
  addFloor("forecourt", {0.0, kEdge + 2.6}, {16.0, 5.2}, random, plans);
  const double inner = kColonnade + 0.45, outer = kHallWall - 0.3, walk = 0.5 * (inner + outer);
  for (int side = 0; side < 4; ++side) {
    // Each side paves one of the ambulatory's corners.
    addFlagstones(fmt::format("ambulatory paving {}", nameSide(side)), side,
                  {0.5 * (outer - inner), walk}, {outer + inner, outer - inner}, random, plans);
    addFlagstones(fmt::format("garden path {}", nameSide(side)), side, {0.0, 5.2}, {3.1, 5.0},
                  random, plans);
  }
  addFlagstones("gate path", 0, {0.0, 16.5}, {2.1, 9.2}, random, plans);
}

}  // namespace

Placement makeSidePlacement(int side) {
  return {{0.0, 0.0, 0.0}, side * kPi / 2};
}

const char* nameSide(int side) {
  static constexpr const char* kNames[] = {"south", "east", "north", "west"};
  return kNames[side];
}

void planBuilding(std::uint64_t seed, Plans& plans) {
  Random random(seed);
  addFloors(random, plans);
  for (int side = 0; side < 4; ++side) {
    addOuterWall(side, random, plans);
    addHallWall(side, random, plans);
    addPartitions(side, random, plans);
    addArcade(side, random, plans);
    addParapet(side, random, plans);
    addColumns(side, random, plans);
    addCornerPier("corner pier", side, kColonnade, 0.95, 4.3, random, plans);
    addCornerPier("corner tower", side, kOuterWall, 1.3, 5.2, random, plans);
    addRoof(side, random, plans);
    addTimber(side, random, plans);
  }
}

}  // namespace hlodbench::courtyard
