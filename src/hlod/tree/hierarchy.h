#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/core/aabb.h"
#include "hlod/scene/triangle_mesh.h"

namespace hlodbench {

using NodeId = std::uint32_t;
inline constexpr NodeId kNoNode = 0xffffffffu;
inline constexpr NodeId kRoot = 0;

// One vertex as the renderer takes it: 24 bytes, no padding.
struct Vertex {
  glm::vec3 position;      // world units
  std::int16_t normal[3];  // unit normal of the full-resolution mesh, signed normalised
  std::uint16_t object;    // index into Hierarchy::objects (modulo 65536)
  std::uint8_t color[4];   // linear RGB of the object, unsigned normalised; alpha unused (255)
};
static_assert(sizeof(Vertex) == 24);

// One node of the HLOD hierarchy: a box, one discrete LOD and its error.
struct Node {
  Aabb box;                 // world units; holds every triangle of the subtree, at every level
  float error = 0.0f;       // world units; 0 in a leaf, never decreases towards the root
  NodeId parent = kNoNode;  // kNoNode for the root
  NodeId firstChild =
      kNoNode;  // children are neighbours: firstChild .. firstChild + childCount - 1
  std::uint32_t childCount = 0;   // 0 to 8; 0 makes a leaf
  std::uint32_t level = 0;        // 0 for the root
  std::uint64_t firstVertex = 0;  // the LOD's vertices in Hierarchy::vertices
  std::uint32_t vertexCount = 0;
  std::uint64_t firstIndex = 0;  // the LOD's triangles in Hierarchy::indices, 3 indices each,
  std::uint32_t indexCount = 0;  // relative to firstVertex
  [[nodiscard]] bool isLeaf() const { return childCount == 0; }
  [[nodiscard]] std::uint32_t triangleCount() const { return indexCount / 3; }
};

// The hierarchy of LODs over a scene. Parents stand before their children, the root is node 0,
// nodes of one level are neighbours (breadth-first order).
struct Hierarchy {
  std::vector<Node> nodes;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<SceneObject> objects;
  std::uint64_t inputTriangles = 0;  // of the scene; equals the sum over the leaves

  [[nodiscard]] const Node& node(NodeId id) const { return nodes[id]; }
  [[nodiscard]] std::span<const Node> children(const Node& n) const {
    return n.isLeaf() ? std::span<const Node>()
                      : std::span<const Node>(&nodes[n.firstChild], n.childCount);
  }
};

// Checks what every user of a hierarchy relies on: one root, parents before children and agreeing
// with them, boxes that nest and hold their vertices, errors that never decrease towards the root
// and are 0 in leaves, index ranges in bounds, leaf triangles summing to inputTriangles.
// Returns an empty string, or one line that says what does not hold and at which node.
std::string validate(const Hierarchy& hierarchy);

}  // namespace hlodbench
