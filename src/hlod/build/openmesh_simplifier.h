#pragma once

#include <memory>

#include "hlod/build/simplifier.h"

namespace hlodbench {

// Half-edge collapses by quadric error (Garland and Heckbert 1997), through OpenMesh's decimater.
// Surfaces that are not manifold are taken apart into manifold layers first; no face is lost by it.
std::unique_ptr<Simplifier> createOpenMeshSimplifier();

}  // namespace hlodbench
