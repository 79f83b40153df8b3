#pragma once

#include <cstdint>

#include "hlod/build/hierarchy_builder.h"

namespace hlodbench {

// How much is built at a time.
struct ChunkBudget {
  std::uint64_t chunkTriangles = 0;
};

// Throws InputError when options.memory is too small, with the least that works.
ChunkBudget computeChunkBudget(const TriangleSource& source, const BuildOptions& options,
                               unsigned threads);

}  // namespace hlodbench
