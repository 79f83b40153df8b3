#include "hlod/tree/memory_sink.h"

#include "hlod/tree/geometry_packer.h"

namespace hlodbench {

void MemorySink::addGeometry(NodeId id, std::span<const Vertex> vertices,
                             std::span<const std::uint32_t> indices) {
  thread_local GeometryPacker packer;
  Block block;
  const auto bytes = packer.pack(vertices, indices, block.node);
  block.bytes.assign(bytes.begin(), bytes.end());
  const std::lock_guard lock(mutex_);
  if (id >= blocks_.size()) blocks_.resize(id + 1);
  blocks_[id] = std::move(block);
}

void MemorySink::finish(Hierarchy& hierarchy, std::span<const NodeId> ids) {
  std::uint64_t total = 0;
  for (const Block& block : blocks_) total += block.bytes.size();
  std::vector<std::byte> geometry;
  geometry.reserve(total);
  for (std::size_t i = 0; i < hierarchy.nodes.size(); ++i) {
    Block& block = blocks_.at(ids.empty() ? i : ids[i]);
    Node& node = hierarchy.nodes[i];
    node.geometryOffset = geometry.size();
    node.geometryHash = block.node.geometryHash;
    node.vertexCount = block.node.vertexCount;
    node.indexCount = block.node.indexCount;
    geometry.insert(geometry.end(), block.bytes.begin(), block.bytes.end());
    block.bytes = {};
  }
  hierarchy.geometry = GeometrySection(std::move(geometry));
}

}  // namespace hlodbench
