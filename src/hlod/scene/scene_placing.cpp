#include "hlod/scene/scene_placing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hlod/core/aabb.h"
#include "hlod/core/error.h"

namespace hlodbench {
namespace {

// Centre of the mesh's box to the origin, its lowest point to the ground, its largest extent to 1.
glm::dmat4 computeNormalizing(const Aabb& box, int upAxis) {
  const glm::dvec3 low(box.min), high(box.max);
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  glm::dvec3 origin = (low + high) * 0.5;
  origin[upAxis] = low[upAxis];
  glm::dmat4 matrix(1.0 / extent);
  matrix[3] = glm::dvec4(-origin / extent, 1.0);
  return matrix;
}

// From the file's axes to ours, where y is up.
glm::dmat4 computeUprighting(int upAxis) {
  if (upAxis == 1) return glm::dmat4(1.0);
  return {glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0),
          glm::dvec4(0, 0, 0, 1)};
}

// Whether all that is in the box lands where a float reaches: its corners do.
bool staysFinite(const Aabb& box, const glm::dmat4& toWorld) {
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) != 0 ? box.max.x : box.min.x,
                       (corner & 2) != 0 ? box.max.y : box.min.y,
                       (corner & 4) != 0 ? box.max.z : box.min.z);
    const glm::vec3 placed(toWorld * glm::dvec4(p, 1.0));
    if (!std::isfinite(placed.x) || !std::isfinite(placed.y) || !std::isfinite(placed.z))
      return false;
  }
  return true;
}

}  // namespace

std::vector<PlacedMesh> placeMeshes(const std::filesystem::path& path,
                                    const SceneDescription& scene,
                                    const std::map<std::string, MeshExtent>& meshes) {
  const glm::dmat4 upright = computeUprighting(scene.upAxis);
  std::vector<PlacedMesh> placed;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  for (const InstanceDescription& instance : scene.instances) {
    const MeshExtent& mesh = meshes.at(instance.mesh);
    vertices += mesh.vertices;
    triangles += mesh.triangles;
    if (std::max(vertices, triangles) > std::numeric_limits<std::uint32_t>::max())
      throw InputError(
          fmt::format("{}: {}: expected fewer than 2^32 vertices and triangles up to "
                      "here, found {} and {}",
                      path.string(), instance.pointer, vertices, triangles));
    PlacedMesh place{upright * instance.placing, false};
    if (instance.normalize) place.toWorld *= computeNormalizing(mesh.box, scene.upAxis);
    if (!staysFinite(mesh.box, place.toWorld))
      throw InputError(
          fmt::format("{}: {}: expected finite coordinates, found a vertex that its "
                      "transform puts too far out for a 32-bit float",
                      path.string(), instance.pointer));
    place.mirrored = glm::determinant(glm::dmat3(place.toWorld)) < 0.0;
    placed.push_back(place);
  }
  return placed;
}

}  // namespace hlodbench
