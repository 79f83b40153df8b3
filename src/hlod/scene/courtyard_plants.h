#pragma once

#include "hlod/scene/courtyard_body.h"
#include "hlod/scene/courtyard_random.h"

namespace hlodbench::courtyard {

// A tree at the origin, 4.5 to 5.5 m high: trunk and boughs, and the crown's clumps of leaves.
struct Tree {
  std::vector<Body> wood;
  std::vector<Body> crown;
};
Tree makeTree(Random& random, double detail);

// A slender cypress, 4 to 5 m high, at most 0.6 m from the axis.
Body makeCypress(Random& random, double detail);

// A clipped hedge that fills size.y upwards from y = 0.
Body makeHedge(const glm::dvec3& size, std::uint64_t seed, double detail);

// A bush of the given radius about the origin.
Body makeBush(double radius, std::uint64_t seed, double detail);

}  // namespace hlodbench::courtyard
