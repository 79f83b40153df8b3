#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "hlod/build/welded_mesh.h"

namespace hlodbench {

// Finds the objects whose triangles are not consistently wound: that have an edge of more than two
// triangles, or of two that pass it the same way. Both say that some directed edge is there twice,
// which is what is looked for. Triangles with two equal corners do not count.
class WindingCheck {
 public:
  explicit WindingCheck(std::size_t objects) : uneven_(objects) {}

  // Looks at a chunk, whose triangles lie over `mesh`. places: the vertices it shares with other
  // chunks; edges between two of them are returned, for finish(). Several threads may call it.
  std::vector<std::uint64_t> addChunk(const WeldedMesh& mesh, std::span<const SharedPlace> places);

  // edges: what addChunk() returned, of all chunks.
  void finish(std::vector<std::uint64_t> edges, const std::vector<SharedVertex>& shared);

  [[nodiscard]] bool isConsistent(std::uint32_t object) const { return !uneven_[object].load(); }

 private:
  std::vector<std::atomic<bool>> uneven_;
};

}  // namespace hlodbench
