#pragma once

#include <glm/glm.hpp>

#include "hlod/scene/courtyard_random.h"

namespace hlodbench::courtyard {

// What a body is made of; each has a few colours that go with those of the others.
enum class Material {
  kWall,
  kColumn,
  kPaving,
  kSoil,
  kRoof,
  kTimber,
  kMarble,
  kBronze,
  kCeramic,
  kLeaf,
  kBark,
  kWater,
};

// A colour of the material, linear RGB in [0, 1], a little different at each call.
glm::vec3 pickColor(Material material, Random& random);

}  // namespace hlodbench::courtyard
