#pragma once

#include "hlod/scene/courtyard_body.h"
#include "hlod/scene/courtyard_random.h"

namespace hlodbench::courtyard {

// A hollow vase on y = 0: closed, with an inner surface down to its floor; 0.7 to 1.2 m high and
// at most 0.42 m from the axis.
Body makeVase(Random& random, double detail);

// A wide hollow bowl on a foot for plants; 0.55 m high, rim radius 0.42 m.
Body makePlanter(Random& random, double detail);

// The fountain's stone: an octagonal basin (outer radius 2.1 m), a stem and two scalloped bowls;
// about 3 m high.
std::vector<Body> makeFountainStone(double detail);

// The fountain's water: rippled discs and falling jets.
std::vector<Body> makeFountainWater(std::uint64_t seed, double detail);

}  // namespace hlodbench::courtyard
