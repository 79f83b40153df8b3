#pragma once

#include <cstdint>
#include <vector>

#include "hlod/build/welded_mesh.h"

namespace hlodbench {

// Says which vertices a node's simplification must leave where they are, so that nodes of
// different levels meet in the very same vertices and no crack opens between them.
class BorderLocks {
 public:
  // mesh: its triangles sorted by computeOctree; kept by reference.
  explicit BorderLocks(const WeldedMesh& mesh);

  // True when triangles outside the range [begin, end) touch the vertex's position, or several
  // objects do. The vertex must belong to a triangle of the range.
  [[nodiscard]] bool isLocked(std::uint32_t vertex, std::uint32_t begin, std::uint32_t end) const {
    const std::uint32_t id = mesh_.positionIds[vertex];
    return first_[id] < begin || last_[id] >= end || mesh_.seams[id] != 0;
  }

  // The first triangle that touches the vertex's position.
  [[nodiscard]] std::uint32_t firstTriangle(std::uint32_t vertex) const {
    return first_[mesh_.positionIds[vertex]];
  }

 private:
  const WeldedMesh& mesh_;
  std::vector<std::uint32_t> first_;  // one a position id: first and last triangle that touch it
  std::vector<std::uint32_t> last_;
};

}  // namespace hlodbench
