#include "hlod/tree/hlod_writer.h"

#include <fmt/format.h>

#include <cstring>
#include <functional>

#include "hlod/core/atomic_file.h"
#include "hlod/core/file_io.h"
#include "hlod/tree/geometry_packer.h"
#include "hlod/tree/hlod_layout.h"

namespace hlodbench {
namespace {

std::string packObjects(const std::vector<SceneObject>& objects) {
  std::string bytes;
  for (const SceneObject& object : objects) {
    const auto length = static_cast<std::uint32_t>(object.name.size());
    bytes.append(reinterpret_cast<const char*>(&object.color), sizeof(object.color));
    bytes.append(reinterpret_cast<const char*>(&length), sizeof(length));
    bytes.append(object.name);
  }
  return bytes;
}

StoredNode packNode(const Node& n) {
  return {n.box,         n.error,      n.parent, n.firstChild,     n.childCount,  n.level,
          n.vertexCount, n.indexCount, n.flags,  n.geometryOffset, n.geometryHash};
}

HlodHeader makeHeader(const Hierarchy& h, const HlodFileInfo& info, const HlodTables& tables,
                      std::uint64_t geometryBytes) {
  HlodHeader header{};
  std::memcpy(header.magic, kHlodMagic, sizeof(kHlodMagic));
  header.version = kHlodFileVersion;
  header.sceneHash = info.sceneHash;
  header.inputTriangles = h.inputTriangles;
  header.geometryOffset = sizeof(HlodHeader);
  header.geometryBytes = geometryBytes;
  header.nodes = tables.nodes.size();
  header.nodesOffset = header.geometryOffset + geometryBytes;
  header.objects = h.objects.size();
  header.objectsBytes = tables.objects.size();
  header.objectsOffset = header.nodesOffset + header.nodes * sizeof(StoredNode);
  header.optionsBytes = static_cast<std::uint32_t>(tables.options.size());
  header.optionsOffset = header.objectsOffset + header.objectsBytes;
  header.fileBytes = header.optionsOffset + header.optionsBytes;
  header.contentHash = computeContentHash(header, tables);
  header.headerHash = computeHeaderHash(header, tables.options);
  return header;
}

// getBlock(i): the block of node i, valid until the next call. Blocks are asked for in the order of
// the nodes, whose offsets are set to where these come to lie.
void writeFile(const std::filesystem::path& path, const Hierarchy& h, std::vector<Node> nodes,
               HlodFileInfo& info,
               const std::function<std::span<const std::byte>(NodeId)>& getBlock) {
  if (info.options.size() > kMaxHlodOptions)
    failOnFile(path, fmt::format("expected options of at most {} bytes, found {}", kMaxHlodOptions,
                                 info.options.size()));
  AtomicFile file(path);
  HlodHeader header{};
  file.write(&header, sizeof(header));
  HlodTables tables{info.options, packObjects(h.objects), {}};
  tables.nodes.reserve(nodes.size());
  std::uint64_t offset = 0;
  for (NodeId id = 0; id < nodes.size(); ++id) {
    const std::span<const std::byte> block = getBlock(id);
    file.write(block.data(), block.size());
    nodes[id].geometryOffset = offset;
    tables.nodes.push_back(packNode(nodes[id]));
    offset += block.size();
  }
  header = makeHeader(h, info, tables, offset);
  file.write(tables.nodes.data(), tables.nodes.size() * sizeof(StoredNode));
  file.write(tables.objects);
  file.write(tables.options);
  file.rewriteStart(&header, sizeof(header));
  file.commit();
  info.version = header.version;
  info.contentHash = header.contentHash;
}

}  // namespace

HlodWriter::HlodWriter(std::filesystem::path path)
    : path_(std::move(path)), spill_(path_.parent_path()) {}

void HlodWriter::addGeometry(NodeId id, std::span<const Vertex> vertices,
                             std::span<const std::uint32_t> indices) {
  thread_local GeometryPacker packer;
  Block block;
  const std::span<const std::byte> bytes = packer.pack(vertices, indices, block.node);
  block.place = spilled_.fetch_add(bytes.size());
  spill_.write(block.place, bytes.data(), bytes.size());
  const std::lock_guard lock(mutex_);
  if (id >= blocks_.size()) blocks_.resize(std::max<std::size_t>(id + 1, blocks_.size() * 2));
  blocks_[id] = block;
}

void HlodWriter::finish(Hierarchy& hierarchy, HlodFileInfo& info, std::span<const NodeId> ids) {
  const auto blockOf = [&](NodeId id) -> const Block& {
    return blocks_.at(ids.empty() ? id : ids[id]);
  };
  std::uint64_t offset = 0;
  for (NodeId id = 0; id < hierarchy.nodes.size(); ++id) {
    const Node& block = blockOf(id).node;
    Node& node = hierarchy.nodes[id];
    node.geometryOffset = offset;
    node.geometryHash = block.geometryHash;
    node.vertexCount = block.vertexCount;
    node.indexCount = block.indexCount;
    offset += node.blockBytes();
  }
  std::vector<std::byte> bytes;
  writeFile(path_, hierarchy, hierarchy.nodes, info, [&](NodeId id) {
    bytes.resize(hierarchy.node(id).blockBytes());
    spill_.read(blockOf(id).place, bytes.data(), bytes.size());
    return std::span<const std::byte>(bytes);
  });
}

void writeHlodFile(const std::filesystem::path& path, const Hierarchy& hierarchy,
                   HlodFileInfo& info) {
  writeFile(path, hierarchy, hierarchy.nodes, info,
            [&](NodeId id) { return hierarchy.geometryBytes(hierarchy.node(id)); });
}

}  // namespace hlodbench
