#include "hlod/build/lod_normals.h"

namespace hlodbench {

std::vector<glm::vec3> computeSmoothedNormals(const WeldedMesh& mesh,
                                              std::span<const glm::uvec3> triangles,
                                              const OctreeNode& node, LocalIndex& local) {
  const std::vector<std::uint32_t>& vertices = local.vertices();
  std::vector<glm::dvec3> sums(vertices.size(), glm::dvec3(0.0));
  for (const glm::uvec3& t : triangles) {
    const glm::dvec3 a = mesh.positions[t.x];
    const glm::dvec3 cross =
        glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a);
    for (int corner = 0; corner < 3; ++corner) sums[local.add(t[corner])] += cross;
  }
  std::vector<glm::vec3> normals(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const glm::vec3 original = mesh.normals[vertices[i]];
    const double length = glm::length(sums[i]);
    const glm::vec3 smoothed = length > 0.0 ? glm::vec3(sums[i] / length) : original;
    const bool keep =
        mesh.isLocked(vertices[i], node.begin, node.end) || !(glm::dot(smoothed, original) > 0.0f);
    normals[i] = keep ? original : smoothed;
  }
  return normals;
}

}  // namespace hlodbench
