#pragma once

#include <cstdint>
#include <vector>

#include "hlod/scene/courtyard_body.h"

namespace hlodbench::courtyard {

// A stretch of a wall, with at most one opening in its middle.
struct WallBay {
  enum class Kind { kBlank, kDoor, kWindow };
  double width = 2.0;
  Kind kind = Kind::kBlank;
  double halfOpening = 0.6;  // under width / 2
};

// A masonry wall along x, centred on x = 0, its middle plane z = 0. All lengths in metres.
struct WallSpec {
  std::vector<WallBay> bays;  // from -x to +x
  double thickness = 0.5;
  double bottom = 0.0;
  double sill = 1.0;     // where windows begin; bottom: there are no windows
  double spring = 2.0;   // where the arches of doors and windows begin
  double top = 4.0;      // above every arch
  double pointed = 0.0;  // 0: round arches; larger: pointed, higher ones
  double blockLength = 1.6;
  double courseHeight = 0.8;
  double relief = 0.075;  // height of the blocks over their joints
  std::uint64_t seed = 1;
};

// One closed surface, of genus one for each opening: the lattice of the wall follows the arches.
Body makeWall(const WallSpec& spec, double detail);

}  // namespace hlodbench::courtyard
