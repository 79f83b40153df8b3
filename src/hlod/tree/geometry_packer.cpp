#include "hlod/tree/geometry_packer.h"

#ifdef HLODBENCH_HAVE_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include "hlod/tree/hasher.h"

namespace hlodbench {

#ifdef HLODBENCH_HAVE_MESHOPTIMIZER

void GeometryPacker::arrange(std::span<const Vertex> vertices,
                             std::span<const std::uint32_t> indices) {
  indices_.resize(indices.size());
  meshopt_optimizeVertexCache(indices_.data(), indices.data(), indices.size(), vertices.size());
  places_.resize(vertices.size());
  const std::size_t used = meshopt_optimizeVertexFetchRemap(places_.data(), indices_.data(),
                                                            indices_.size(), vertices.size());
  vertices_.resize(used);
  for (std::size_t v = 0; v < vertices.size(); ++v)
    if (places_[v] != ~0u) vertices_[places_[v]] = vertices[v];
  for (std::uint32_t& index : indices_) index = places_[index];
}

#else

void GeometryPacker::arrange(std::span<const Vertex> vertices,
                             std::span<const std::uint32_t> indices) {
  vertices_.assign(vertices.begin(), vertices.end());
  indices_.assign(indices.begin(), indices.end());
}

#endif

std::span<const std::byte> GeometryPacker::pack(std::span<const Vertex> vertices,
                                                std::span<const std::uint32_t> indices,
                                                Node& node) {
  arrange(vertices, indices);
  node.vertexCount = static_cast<std::uint32_t>(vertices_.size());
  node.indexCount = static_cast<std::uint32_t>(indices_.size());
  block_.assign(node.blockBytes(), std::byte{0});
  const std::size_t vertexBytes = vertices_.size() * sizeof(Vertex);
  if (vertexBytes > 0) std::memcpy(block_.data(), vertices_.data(), vertexBytes);
  std::byte* at = block_.data() + vertexBytes;
  const std::size_t width = node.hasNarrowIndices() ? 2 : 4;
  // little-endian: the low bytes come first
  for (const std::uint32_t index : indices_) {
    std::memcpy(at, &index, width);
    at += width;
  }
  node.geometryHash = computeHash(block_);
  return block_;
}

}  // namespace hlodbench
