#pragma once

#include <cstdint>

#include "hlod/scene/triangle_mesh.h"

namespace hlodbench {

// The embedded scene: a walled courtyard of colonnades with detailed bodies between and behind
// them, made by code alone, so that a reader with no model at hand can run the comparison.
// y is up, the ground is y = 0, one unit is one metre.
struct CourtyardOptions {
  std::uint64_t seed = 1;               // decides every random choice; same seed, same bytes
  std::uint32_t triangles = 1'000'000;  // wanted number; met within 5 %
};

// The scene's triangles; every body is a closed surface of its own.
// Throws InputError when options.triangles is under 50,000 or over 20,000,000.
TriangleMesh generateCourtyard(const CourtyardOptions& options = {});

}  // namespace hlodbench
