#include "hlod/build/welded_mesh.h"

#include <algorithm>

#include "hlod/build/position_table.h"

namespace hlodbench {
namespace {

// Where normals cancel out (mixed winding) or every face is degenerate: the normal of a face that
// has one, else +z, for a normal of no length would shade black. vertices: in increasing order.
void chooseNormals(std::span<const SceneTriangle> triangles, double scale,
                   std::span<const std::uint32_t> vertices, WeldedMesh& mesh) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t v = mesh.triangles[i][corner];
      if (!std::binary_search(vertices.begin(), vertices.end(), v)) continue;
      const glm::dvec3 cross = scaledCross(triangles[i], scale);
      mesh.normals[v] = chooseNormal(mesh.normals[v], unitNormal(cross, glm::length(cross)));
    }
  }
  for (const std::uint32_t v : vertices)
    if (mesh.normals[v] == glm::vec3(0.0f)) mesh.normals[v] = glm::vec3(0.0f, 0.0f, 1.0f);
}

// Area-weighted normals.
void computeNormals(std::span<const SceneTriangle> triangles, double scale, WeldedMesh& mesh) {
  struct Sum {
    glm::dvec3 cross{0.0};
    double length = 0.0;
  };
  std::vector<Sum> sums(mesh.positions.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const glm::dvec3 cross = scaledCross(triangles[i], scale);
    const double length = glm::length(cross);
    for (int corner = 0; corner < 3; ++corner) {
      sums[mesh.triangles[i][corner]].cross += cross;
      sums[mesh.triangles[i][corner]].length += length;
    }
  }
  mesh.normals.resize(sums.size());
  std::vector<std::uint32_t> missing;
  for (std::uint32_t v = 0; v < sums.size(); ++v) {
    mesh.normals[v] = unitNormal(sums[v].cross, sums[v].length);
    if (mesh.normals[v] == glm::vec3(0.0f)) missing.push_back(v);
  }
  if (!missing.empty()) chooseNormals(triangles, scale, missing, mesh);
}

void computeLocks(const std::vector<std::uint8_t>& seams, WeldedMesh& mesh) {
  mesh.lockFirst.assign(seams.size(), 0xffffffffu);
  mesh.lockLast.assign(seams.size(), 0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t v = mesh.triangles[t][corner];
      mesh.lockFirst[v] = std::min(mesh.lockFirst[v], t);
      mesh.lockLast[v] = t;
    }
  }
  for (std::size_t v = 0; v < seams.size(); ++v)
    if (seams[v] != 0) mesh.lockLast[v] = kLockedEverywhere;
}

}  // namespace

WeldedMesh computeWeldedMesh(std::span<const SceneTriangle> triangles, double scale,
                             const std::vector<SharedVertex>& shared,
                             std::span<const std::uint32_t> ofChunk,
                             std::vector<SharedPlace>* places) {
  WeldedMesh mesh;
  std::vector<std::uint8_t> seams;
  PositionTable table(triangles.size() * 5 / 8);
  mesh.triangles.resize(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      mesh.triangles[i][corner] = table.add(triangles[i].corners[corner], triangles[i].object,
                                            mesh.positions, mesh.objects, seams);
  computeNormals(triangles, scale, mesh);
  computeLocks(seams, mesh);
  for (const std::uint32_t index : ofChunk) {
    const SharedVertex& s = shared[index];
    const std::uint32_t v = table.find(s.position, s.object, mesh.positions, mesh.objects);
    mesh.normals[v] = s.normal;
    mesh.lockLast[v] = kLockedEverywhere;
    if (places != nullptr) places->push_back({v, index});
  }
  return mesh;
}

}  // namespace hlodbench
