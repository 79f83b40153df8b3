#include "hlod/build/chunk_budget.h"

#include <fmt/format.h>

#include <algorithm>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

// Without a limit: enough chunks for many threads, none so small that there is much to share.
constexpr std::uint64_t kManyChunks = 64;
constexpr std::uint64_t kMostTriangles = 131072;
// Under a limit: what building takes for each triangle of the chunks that are worked on, measured,
// with as much again for what grows with the scene (samples, shared vertices, the nodes).
constexpr std::uint64_t kBytesATriangle = 1000;
constexpr std::uint64_t kFixedBytes = std::uint64_t{64} << 20;

}  // namespace

ChunkBudget computeChunkBudget(const TriangleSource& source, const BuildOptions& options,
                               unsigned threads) {
  const std::uint64_t least = std::max<std::uint64_t>(options.exactTriangles, options.maxTriangles);
  std::uint64_t chunk = options.chunkTriangles;
  if (chunk == 0) chunk = std::min(source.triangleCount() / kManyChunks, kMostTriangles);
  if (options.memory > 0) {
    const std::uint64_t fixed = kFixedBytes + source.memoryBytes();
    const std::uint64_t each = kBytesATriangle * threads;
    if (options.memory < fixed + least * each)
      throw InputError(fmt::format(
          "--memory: expected at least {}M for this scene and {} threads, found {}M",
          (fixed + least * each + (1u << 20) - 1) >> 20, threads, options.memory >> 20));
    if (options.chunkTriangles == 0) chunk = (options.memory - fixed) / each;
  }
  return {std::max(chunk, least)};
}

}  // namespace hlodbench
