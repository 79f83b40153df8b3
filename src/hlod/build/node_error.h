#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hlod/build/surface_samples.h"
#include "hlod/build/welded_mesh.h"
#include "hlod/core/aabb.h"

namespace hlodbench {

// What stands for a node's distances from the original surface.
enum class ErrorMeasure {
  kLargest,  // computeNodeError(): a bound
  kRms       // computeRmsError(): what a picture shows of it
};

// The LOD whose error is wanted.
struct LodSurface {
  const WeldedMesh& mesh;
  std::span<const glm::uvec3> triangles;  // over the mesh's vertices, at least one
  Aabb box;                               // of the node, world units
  float childError = 0.0f;                // the children's largest error
};

// What computeNodeError() remembers of vertices; kept between nodes, so that its memory is taken
// once.
class VertexNotes {
 public:
  // Forgets all of them; vertices: of the mesh.
  void reset(std::size_t vertices) {
    if (round_.size() < vertices) round_.resize(vertices, 0);
    if (found_.size() < vertices) found_.resize(vertices);
    if (++now_ != 0) return;
    round_.assign(round_.size(), 0);
    now_ = 1;
  }
  [[nodiscard]] bool has(std::uint32_t vertex) const { return round_[vertex] == now_; }
  [[nodiscard]] std::uint32_t get(std::uint32_t vertex) const { return found_[vertex]; }
  void set(std::uint32_t vertex, std::uint32_t found) {
    round_[vertex] = now_;
    found_[vertex] = found;
  }

 private:
  std::vector<std::uint32_t> round_;
  std::vector<std::uint32_t> found_;
  std::uint32_t now_ = 0;
};

// The distance (world units, >= childError) from the original surface of a node to its LOD, one
// side only: the distance from the LOD to the original is not promised.
// It is the largest over all original vertices, and over the original faces: a face whose corners
// are all within a distance of one and the same triangle of the LOD is within it as a whole,
// because the distance to a triangle is convex; in other faces it is measured at random points. Two
// a triangle, but at least half of `faceSamples` and at most all, are dealt out evenly by area; of
// the points of the original surface at most about 1 in as many may lie further away.
// original: the node's original triangles, over the same mesh's vertices.
float computeNodeError(const LodSurface& lod, std::span<const glm::uvec3> original,
                       std::uint32_t faceSamples, VertexNotes& notes);

// The same for a node of many triangles: the largest over a sample of points of the original faces
// and one of the original vertices; of either at most about 1 in as many as the sample has may lie
// further away.
float computeNodeError(const LodSurface& lod, const SurfaceSamples& original);

// The root of the mean squared distance (world units, >= childError) from the original surface of a
// node to its LOD, over a sample of points of the original faces.
float computeRmsError(const LodSurface& lod, const SurfaceSamples& original);

}  // namespace hlodbench
