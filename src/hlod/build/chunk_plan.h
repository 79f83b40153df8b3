#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "hlod/build/cell_codes.h"
#include "hlod/scene/triangle_source.h"

namespace hlodbench {

// A node of the octree that holds more triangles than one chunk, or a chunk's root.
struct TopNode {
  std::uint64_t cell = 0;  // its number among the cells `depth` cuts below the root
  unsigned depth = 0;
  std::uint64_t triangles = 0;
  std::vector<std::uint32_t> children;  // 2 to 8, in the order of their codes; none: a chunk
  std::uint32_t firstChunk = 0;         // the chunks below it, itself when it is one
  std::uint32_t endChunk = 0;
  [[nodiscard]] bool isChunk() const { return children.empty(); }
};

// The scene cut into chunks that are built one by one. A chunk is a node of the very octree that
// would be made of the whole scene, so the cut does not change the tree.
struct ChunkPlan {
  std::vector<TopNode> nodes;             // the root first, parents before children
  std::vector<std::uint32_t> chunks;      // their nodes, in the order of their codes
  std::vector<std::uint64_t> firstCodes;  // one a chunk: the least code it can hold

  // The chunk of a triangle with this code. near: where to look first, then the chunk found.
  void find(std::uint64_t code, std::uint32_t& near) const;
};

// Chunks of at most chunkTriangles (more only where centroids nearly coincide). Reads the source
// once, and again where many triangles lie in a small part of the box.
ChunkPlan computeChunkPlan(const TriangleSource& source, const CellCodes& codes,
                           std::uint64_t chunkTriangles, unsigned threads,
                           const std::function<void(double)>& report = {});

}  // namespace hlodbench
