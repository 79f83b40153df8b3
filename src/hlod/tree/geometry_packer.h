#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// Makes blocks of geometry: triangles in an order that the GPU's vertex cache likes, vertices in
// the order in which these use them (meshoptimizer; built without it, both stay as they are), then
// the bytes that Node describes. Equal input makes equal bytes. Keeps its memory between blocks;
// one a thread. A block lives in it.
class GeometryPacker {
 public:
  // indices: 3 a triangle, below vertices.size(). The block is valid until the next call; what of
  // `node` describes it is set, but for its offset.
  std::span<const std::byte> pack(std::span<const Vertex> vertices,
                                  std::span<const std::uint32_t> indices, Node& node);

 private:
  // Sets vertices_ and indices_.
  void arrange(std::span<const Vertex> vertices, std::span<const std::uint32_t> indices);

  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> indices_, places_;
  std::vector<std::byte> block_;
};

}  // namespace hlodbench
