#pragma once

#include <memory>

#include "hlod/build/simplifier.h"

namespace hlodbench {

// Half-edge collapses by quadric error (Garland and Heckbert 1997), through OpenMesh's decimater.
// Surfaces that are not manifold are taken apart into manifold layers first; no face is lost by it.
// Where topology keeps the decimater from the target (many handles or small bodies), collapses that
// close handles and fold bodies up finish the work.
std::unique_ptr<Simplifier> createOpenMeshSimplifier();

}  // namespace hlodbench
