#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <type_traits>

#include "hlod/tree/hierarchy.h"

// How a hierarchy file is laid out: docs/hlod-format.md.
namespace hlodbench {

static_assert(std::endian::native == std::endian::little, "the file holds the machine's own bytes");
static_assert(std::is_trivially_copyable_v<Vertex>);

inline constexpr char kHlodMagic[8] = {'H', 'L', 'O', 'D', 'T', 'R', 'E', 'E'};
inline constexpr std::uint64_t kMaxHlodOptions = 65536;  // bytes

// Offsets are from the start of the file.
struct HlodHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t optionsBytes;
  std::uint64_t contentHash;  // of header (both hashes 0), options, objects and nodes
  std::uint64_t headerHash;   // of header (this hash 0) and options
  std::uint64_t fileBytes;
  std::uint64_t sceneHash;
  std::uint64_t inputTriangles;
  std::uint64_t optionsOffset;
  std::uint64_t objects, objectsOffset, objectsBytes;
  std::uint64_t nodes, nodesOffset;
  std::uint64_t geometryOffset, geometryBytes;
  std::uint64_t reserved;  // 0
};
static_assert(sizeof(HlodHeader) == 128 && sizeof(HlodHeader) % kBlockAlignment == 0);

// A node as stored: no padding, so that equal hierarchies make equal bytes.
struct StoredNode {
  Aabb box;
  float error;
  std::uint32_t parent, firstChild, childCount, level;
  std::uint32_t vertexCount, indexCount, flags;
  std::uint64_t geometryOffset, geometryHash;  // offset from the start of the geometry
};
static_assert(sizeof(StoredNode) == 72);

// The three checked things that stand beside the geometry, as stored.
struct HlodTables {
  std::string options;
  std::string objects;  // each its colour (12 bytes), the length of its name (4), the name
  std::vector<StoredNode> nodes;
};

std::uint64_t computeHeaderHash(HlodHeader header, const std::string& options);
std::uint64_t computeContentHash(HlodHeader header, const HlodTables& tables);

}  // namespace hlodbench
