#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/build/welded_mesh.h"

namespace hlodbench {

// Points of the original surface below a node, from which the errors of large nodes are measured.
// A parent's are chosen from its children's, so no node needs the original triangles again.
struct SurfaceSamples {
  std::vector<glm::vec3> facePoints;  // evenly by area
  std::vector<glm::vec3> vertices;    // evenly among the triangles' corners
  double area = 0.0;                  // of the original triangles, square world units
  std::uint64_t triangles = 0;        // their number
};

// Takes one random point in every equal share of the area, and one of every so many corners: about
// as many as there are triangles, at most `most` points and half as many vertices. The same in
// every run.
SurfaceSamples takeSamples(const WeldedMesh& mesh, std::span<const glm::uvec3> triangles,
                           std::uint32_t most);

// Chooses from several sets, from each in proportion to its area and its triangles.
SurfaceSamples joinSamples(std::span<const SurfaceSamples* const> sets, std::uint32_t most);

}  // namespace hlodbench
