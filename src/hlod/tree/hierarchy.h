#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/core/aabb.h"
#include "hlod/scene/triangle_mesh.h"
#include "hlod/tree/geometry_section.h"

namespace hlodbench {

using NodeId = std::uint32_t;
inline constexpr NodeId kNoNode = 0xffffffffu;
inline constexpr NodeId kRoot = 0;

// One vertex as the renderer takes it: 16 bytes, no padding.
struct Vertex {
  glm::vec3 position;     // world units, exactly the input's: neighbours meet in equal bits
  std::int8_t normal[2];  // unit normal of the full-resolution mesh, see octahedral.h
  std::uint16_t object;   // index into Hierarchy::objects, whose colour it has
};
static_assert(sizeof(Vertex) == 16);

// What a vertex can tell apart.
inline constexpr std::size_t kMaxObjects = 65536;

// Node::flags: every triangle's front face is outside where the input says so, so back faces may
// be culled.
inline constexpr std::uint32_t kConsistentWinding = 1;

// Blocks of geometry start at multiples of it, and end there.
inline constexpr std::uint64_t kBlockAlignment = 16;

// One node of the HLOD hierarchy: a box, one discrete LOD and its error.
struct Node {
  Aabb box;                 // world units; holds every triangle of the subtree, at every level
  float error = 0.0f;       // world units; 0 in a leaf, never decreases towards the root
  NodeId parent = kNoNode;  // kNoNode for the root
  NodeId firstChild =
      kNoNode;  // children are neighbours: firstChild .. firstChild + childCount - 1
  std::uint32_t childCount = 0;  // 0 to 8; 0 makes a leaf
  std::uint32_t level = 0;       // 0 for the root
  // The LOD: one block of bytes, its vertices and then its indices, 3 a triangle
  std::uint64_t geometryOffset = 0;  // bytes into Hierarchy::geometry
  std::uint64_t geometryHash = 0;    // of the block, see computeHash()
  std::uint32_t vertexCount = 0;
  std::uint32_t indexCount = 0;
  std::uint32_t flags = 0;  // kConsistentWinding
  [[nodiscard]] bool isLeaf() const { return childCount == 0; }
  [[nodiscard]] std::uint32_t triangleCount() const { return indexCount / 3; }
  // Indices are stored in 16 bits where they fit, else in 32.
  [[nodiscard]] bool hasNarrowIndices() const { return vertexCount <= 65536; }
  [[nodiscard]] std::uint64_t indexOffset() const {
    return geometryOffset + std::uint64_t{vertexCount} * sizeof(Vertex);
  }
  // Size of the block, with the zeros that fill it up.
  [[nodiscard]] std::uint64_t blockBytes() const {
    const std::uint64_t bytes = std::uint64_t{vertexCount} * sizeof(Vertex) +
                                std::uint64_t{indexCount} * (hasNarrowIndices() ? 2 : 4);
    return (bytes + kBlockAlignment - 1) / kBlockAlignment * kBlockAlignment;
  }
};

// A node's indices, whatever their width, below its vertexCount.
class NodeIndices {
 public:
  NodeIndices(const std::byte* data, std::size_t count, bool narrow)
      : data_(data), count_(count), narrow_(narrow) {}
  [[nodiscard]] std::size_t size() const { return count_; }
  std::uint32_t operator[](std::size_t i) const {
    return narrow_ ? get<std::uint16_t>(i) : get<std::uint32_t>(i);
  }

 private:
  template <typename T>
  [[nodiscard]] T get(std::size_t i) const {
    T value;
    std::memcpy(&value, data_ + i * sizeof(T), sizeof(T));
    return value;
  }

  const std::byte* data_;
  std::size_t count_;
  bool narrow_;
};

// The hierarchy of LODs over a scene. Parents stand before their children, the root is node 0,
// nodes of one level are neighbours (breadth-first order). Its geometry may be a mapped file, of
// which nothing is in memory until it is looked at.
struct Hierarchy {
  std::vector<Node> nodes;
  std::vector<SceneObject> objects;
  std::uint64_t inputTriangles = 0;  // of the scene; equals the sum over the leaves
  GeometrySection geometry;          // the nodes' blocks

  [[nodiscard]] const Node& node(NodeId id) const { return nodes[id]; }
  [[nodiscard]] std::span<const Node> children(const Node& n) const {
    return n.isLeaf() ? std::span<const Node>()
                      : std::span<const Node>(&nodes[n.firstChild], n.childCount);
  }

  [[nodiscard]] std::span<const std::byte> geometryBytes(const Node& n) const {
    return geometry.bytes().subspan(n.geometryOffset, n.blockBytes());
  }
  [[nodiscard]] std::span<const Vertex> vertices(const Node& n) const {
    return {reinterpret_cast<const Vertex*>(geometry.bytes().data() + n.geometryOffset),
            n.vertexCount};
  }
  [[nodiscard]] NodeIndices indices(const Node& n) const {
    return {geometry.bytes().data() + n.indexOffset(), n.indexCount, n.hasNarrowIndices()};
  }
};

// Says whether the node's block lies within the hierarchy's geometry, as all that reads it expects.
bool isGeometryInRange(const Hierarchy& hierarchy, const Node& node);

// Compares the node's block with its checksum, which reads all of it. Throws InputError naming the
// file and the node.
void checkGeometryHash(const Hierarchy& hierarchy, NodeId id);

// Checks what every user of a hierarchy relies on: one root, parents before children and agreeing
// with them, boxes that nest and hold their vertices, errors that never decrease towards the root
// and are 0 in leaves, blocks and indices in bounds and as their checksums say, objects that exist,
// leaf triangles summing to inputTriangles. Reads all geometry.
// Returns an empty string, or one line that says what does not hold and at which node.
std::string validate(const Hierarchy& hierarchy);

}  // namespace hlodbench
