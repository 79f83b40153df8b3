#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/build/shared_vertices.h"
#include "hlod/scene/triangle_source.h"

namespace hlodbench {

// WeldedMesh::lockLast of a vertex that must stay in every node.
inline constexpr std::uint32_t kLockedEverywhere = 0xffffffffu;

// Triangles with equal corners joined: what a part of the hierarchy is built from. A vertex is
// unique by exact position and object, and used by a triangle.
struct WeldedMesh {
  std::vector<glm::vec3> positions;    // one a vertex
  std::vector<glm::vec3> normals;      // one a vertex: unit length, area-weighted
  std::vector<std::uint32_t> objects;  // one a vertex: index into TriangleSource::objects()
  // One a vertex: the first and the last piece that touches it. Pieces are the triangles of a
  // chunk, or the chunks of a scene; a node holds a range of them.
  std::vector<std::uint32_t> lockFirst;
  std::vector<std::uint32_t> lockLast;
  std::vector<glm::uvec3> triangles;

  // Whether a vertex must stay where it is in the node that holds the pieces [begin, end), so that
  // nodes of different levels meet in the very same vertices and no crack opens between them: it
  // is touched from outside the node, or several objects meet there.
  [[nodiscard]] bool isLocked(std::uint32_t vertex, std::uint32_t begin, std::uint32_t end) const {
    return lockFirst[vertex] < begin || lockLast[vertex] >= end;
  }
};

// A vertex of a chunk that other chunks have, too.
struct SharedPlace {
  std::uint32_t vertex;  // of the welded mesh
  std::uint32_t shared;  // index into SharedVertices::vertices
};

// Welds the triangles of one chunk, in their order. shared: the vertices that it has in common with
// others: they are locked everywhere and take their normal from there. scale: see normalScale().
// places, where given, gets them in the order of `ofChunk`.
WeldedMesh computeWeldedMesh(std::span<const SceneTriangle> triangles, double scale,
                             const std::vector<SharedVertex>& shared = {},
                             std::span<const std::uint32_t> ofChunk = {},
                             std::vector<SharedPlace>* places = nullptr);

}  // namespace hlodbench
