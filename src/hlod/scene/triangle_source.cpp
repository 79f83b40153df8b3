#include "hlod/scene/triangle_source.h"

#include <fmt/format.h>

#include <cmath>

#include "hlod/core/error.h"
#include "hlod/scene/part_size.h"

namespace hlodbench {

MeshTriangles::MeshTriangles(const TriangleMesh& mesh) : mesh_(mesh) {
  if (mesh.objects.size() != mesh.triangles.size())
    throw InputError(fmt::format("mesh: expected one object a triangle ({}), found {}",
                                 mesh.triangles.size(), mesh.objects.size()));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError(fmt::format(
          "mesh: vertex {}: expected finite coordinates, found ({}, {}, {})", i, p.x, p.y, p.z));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner)
      if (mesh.triangles[i][corner] >= mesh.positions.size())
        throw InputError(
            fmt::format("mesh: triangle {}: expected vertex indices below {}, found {}", i,
                        mesh.positions.size(), mesh.triangles[i][corner]));
    if (mesh.objects[i] >= mesh.objectTable.size())
      throw InputError(fmt::format("mesh: triangle {}: expected an object below {}, found {}", i,
                                   mesh.objectTable.size(), mesh.objects[i]));
  }
}

void MeshTriangles::read(std::uint64_t first, std::span<SceneTriangle> out) const {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const glm::uvec3& t = mesh_.triangles[first + i];
    // Adding 0 makes -0 into 0 and changes nothing else.
    for (int corner = 0; corner < 3; ++corner)
      out[i].corners[corner] = mesh_.positions[t[corner]] + 0.0f;
    out[i].object = mesh_.objects[first + i];
  }
}

double MeshTriangles::computePartSize() const {
  return computeMeanPartSize(mesh_.positions, mesh_.triangles);
}

}  // namespace hlodbench
