#pragma once

#include <cstdint>
#include <vector>

#include "hlod/scene/courtyard_body.h"

// Where everything stands. Seen from above, squares about the origin (half sides in metres): the
// garden within the colonnade, the ambulatory between the colonnade and the hall wall, a ring of
// twelve chambers between the hall wall and the outer wall; the gate is in the outer wall's south
// (+z) side. Sides are numbered 0 south, 1 east (+x), 2 north, 3 west.
namespace hlodbench::courtyard {

inline constexpr double kColonnade = 8.05;
inline constexpr double kHallWall = 11.6;
inline constexpr double kOuterWall = 16.0;
inline constexpr double kBayWidth = 2.3;  // between columns; seven bays a side

// From a side's frame (x along the wall, z outwards) to the world.
Placement makeSidePlacement(int side);
const char* nameSide(int side);

// Walls, colonnades, roofs and floors. Adds to plans.
void planBuilding(std::uint64_t seed, std::vector<ObjectPlan>& plans);

// Fountain, trees, hedges, and what stands between them. Adds to plans.
void planGarden(std::uint64_t seed, std::vector<ObjectPlan>& plans);

// What stands in the ambulatory, in the chambers and before the gate. Adds to plans.
void planHalls(std::uint64_t seed, std::vector<ObjectPlan>& plans);

}  // namespace hlodbench::courtyard
