#pragma once

#include "hlod/scene/courtyard_body.h"
#include "hlod/scene/courtyard_random.h"

// Detailed bodies that stand on y = 0 about the y axis. The random numbers decide their forms.
namespace hlodbench::courtyard {

inline constexpr int kSculptureKinds = 6;

// One of the sculptures below, by number: 0 to kSculptureKinds - 1; 0.9 to 1.9 m high without
// pedestal and at most 0.65 m from the axis.
std::vector<Body> makeSculpture(int kind, Random& random);

std::vector<Body> makeFigure(Random& random);      // a draped standing figure, about 1.8 m
std::vector<Body> makeKnotwork(Random& random);    // a torus knot set upright
std::vector<Body> makeSupershape(Random& random);  // Gielis' superformula in both angles (2003)
std::vector<Body> makeCoral(Random& random);       // a sphere with rounded spikes
std::vector<Body> makeShell(Random& random);       // a ribbed sea snail
std::vector<Body> makeFlame(Random& random);       // a twisted, lobed spire

// A moulded block, square in plan, that fills y from 0 to height.
Body makePedestal(double width, double height, double detail);

}  // namespace hlodbench::courtyard
