#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "hlod/render/renderer.h"

namespace hlodbench {

// How much of what was drawn in one frame is seen in its picture.
struct VisibleParts {
  std::size_t nodes = 0;      // to which a pixel belongs
  std::size_t triangles = 0;  // to which a pixel belongs, of all these nodes
};

// Draws the nodes again, in this order, with their numbers and those of their triangles as colours,
// and counts. nodes: each once. Absent where 24 bits are too few for the numbers: more than 2^24
// nodes, or triangles in one.
std::optional<VisibleParts> countVisibleParts(const Hierarchy& hierarchy, Renderer& renderer,
                                              const Camera& camera, std::span<const NodeId> nodes);

}  // namespace hlodbench
