#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "hlod/core/aabb.h"
#include "hlod/scene/triangle_source.h"

namespace hlodbench {

// A cell is cut in 8 no more often than this.
inline constexpr unsigned kMaxOctreeDepth = 20;

// Says in which cells of the octree over a scene a triangle lies, by its centroid.
class CellCodes {
 public:
  // box: of the whole scene; its longest side is the root cell's. Where the scene is flatter than
  // that, cells are first cut across its short side when they are less than twice as high.
  explicit CellCodes(const Aabb& box);

  // The path from the root cell to the deepest cell: 3 bits a cut, the first on top.
  [[nodiscard]] std::uint64_t codeOf(const SceneTriangle& triangle) const;

 private:
  glm::dvec3 corner_;
  double scale_;
};

// The number of the cell `depth` cuts below the root that holds a deepest cell.
inline std::uint64_t cellAt(std::uint64_t code, unsigned depth) {
  return code >> 3 * (kMaxOctreeDepth - depth);
}

// The number of cuts after which two paths part; kMaxOctreeDepth when they are the same.
unsigned commonDepth(std::uint64_t a, std::uint64_t b);

}  // namespace hlodbench
