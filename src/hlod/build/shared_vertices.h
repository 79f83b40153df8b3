#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/build/chunk_store.h"
#include "hlod/core/aabb.h"

namespace hlodbench {

// A vertex, unique by exact position and object, whose position triangles of several chunks touch.
struct SharedVertex {
  glm::vec3 position;
  std::uint32_t object;
  glm::vec3 normal;          // over the faces of all chunks
  std::uint32_t firstChunk;  // that touch the position
  std::uint32_t lastChunk;
  bool seam;  // several objects meet there
};

struct SharedVertices {
  std::vector<SharedVertex> vertices;
  std::vector<std::vector<std::uint32_t>> ofChunk;  // those that each chunk has
};

// The face's normal, as long as twice its area; scale: see normalScale().
glm::dvec3 scaledCross(const SceneTriangle& triangle, double scale);
// What brings a scene of this box to size 1, so that areas are numbers of a sane range.
double normalScale(const Aabb& box);
// The unit vector of a sum of face normals whose lengths add up to `length`; zero where they cancel
// out (mixed winding).
glm::vec3 unitNormal(const glm::dvec3& sum, double length);
// One of two normals, whichever comes first, zero only if both are: what a vertex gets where all
// cancel out.
glm::vec3 chooseNormal(const glm::vec3& a, const glm::vec3& b);

// boxes: tight, one a chunk. A chunk is looked at twice in all: here and when it is built.
SharedVertices findSharedVertices(const ChunkStore& store, const std::vector<Aabb>& boxes,
                                  double scale, unsigned threads);

}  // namespace hlodbench
