#pragma once

#include <memory>

#include "hlod/build/simplifier.h"

namespace hlodbench {

// Whether this build has the meshoptimizer library.
#ifdef HLODBENCH_HAVE_MESHOPTIMIZER
inline constexpr bool kHaveMeshoptimizer = true;
#else
inline constexpr bool kHaveMeshoptimizer = false;
#endif

// meshoptimizer's meshopt_simplify, with locked borders. The library locks topological borders
// only, so each locked vertex that is not on one is made one by a small fin (a triangle of its own
// to two vertices of its own), taken away afterwards. Where a locked vertex is lost
// nevertheless, or more than 5/4 of the target is left (it moves no vertex where surfaces meet),
// the node goes to the OpenMesh simplifier, which is counted as a fallback. Null where the library
// is not there.
std::unique_ptr<Simplifier> createMeshoptSimplifier();

}  // namespace hlodbench
