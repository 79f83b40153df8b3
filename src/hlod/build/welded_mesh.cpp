#include "hlod/build/welded_mesh.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

#include "hlod/core/error.h"

namespace hlodbench {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

void checkMesh(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw InputError("mesh: expected at least one triangle, found none");
  if (mesh.triangles.size() >= kNone || mesh.positions.size() >= kNone)
    throw InputError(
        fmt::format("mesh: expected fewer than {} triangles and vertices, found {} "
                    "and {}",
                    kNone, mesh.triangles.size(), mesh.positions.size()));
  if (mesh.objects.size() != mesh.triangles.size())
    throw InputError(fmt::format("mesh: expected one object a triangle ({}), found {}",
                                 mesh.triangles.size(), mesh.objects.size()));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw InputError(
          fmt::format("mesh: vertex {}: expected finite coordinates, found ({}, {}, "
                      "{})",
                      i, p.x, p.y, p.z));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner)
      if (mesh.triangles[i][corner] >= mesh.positions.size())
        throw InputError(
            fmt::format("mesh: triangle {}: expected vertex indices below {}, found "
                        "{}",
                        i, mesh.positions.size(), mesh.triangles[i][corner]));
    if (mesh.objects[i] >= mesh.objectTable.size())
      throw InputError(fmt::format("mesh: triangle {}: expected an object below {}, found {}", i,
                                   mesh.objectTable.size(), mesh.objects[i]));
  }
}

std::uint64_t hashPosition(const glm::vec3& p) {
  std::uint64_t h = std::bit_cast<std::uint32_t>(p.x);
  h = h * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint32_t>(p.y);
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u + std::bit_cast<std::uint32_t>(p.z);
  h = (h ^ (h >> 32)) * 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}

// Gives equal positions one id, and equal (position, object) pairs one vertex.
class Welder {
 public:
  Welder(const TriangleMesh& mesh, WeldedMesh& out)
      : mesh_(mesh), out_(out), idOfInput_(mesh.positions.size(), kNone) {
    table_.assign(std::bit_ceil(mesh.positions.size() + mesh.positions.size() / 2 + 16), kNone);
  }

  std::uint32_t vertexOf(std::uint32_t inputVertex, std::uint32_t object) {
    std::uint32_t& id = idOfInput_[inputVertex];
    // Adding 0 makes -0 into 0 and changes nothing else.
    const glm::vec3 position = mesh_.positions[inputVertex] + 0.0f;
    if (id == kNone) id = idOf(position);
    std::uint32_t last = kNone;
    for (std::uint32_t v = firstVertex_[id]; v != kNone; last = v, v = nextVertex_[v])
      if (out_.objects[v] == object) return v;
    return addVertex(position, object, id, last);
  }

 private:
  std::uint32_t idOf(const glm::vec3& position) {
    const std::size_t mask = table_.size() - 1;
    for (std::size_t slot = hashPosition(position) & mask;; slot = (slot + 1) & mask) {
      const std::uint32_t id = table_[slot];
      if (id == kNone) {
        table_[slot] = static_cast<std::uint32_t>(firstVertex_.size());
        firstVertex_.push_back(kNone);
        out_.seams.push_back(0);
        return table_[slot];
      }
      if (out_.positions[firstVertex_[id]] == position) return id;
    }
  }

  std::uint32_t addVertex(const glm::vec3& position, std::uint32_t object, std::uint32_t id,
                          std::uint32_t last) {
    const auto vertex = static_cast<std::uint32_t>(out_.positions.size());
    if (last == kNone) {
      firstVertex_[id] = vertex;
    } else {
      nextVertex_[last] = vertex;
      out_.seams[id] = 1;
    }
    out_.positions.push_back(position);
    out_.objects.push_back(object);
    out_.positionIds.push_back(id);
    out_.box.extend(position);
    nextVertex_.push_back(kNone);
    return vertex;
  }

  const TriangleMesh& mesh_;
  WeldedMesh& out_;
  std::vector<std::uint32_t> idOfInput_;
  std::vector<std::uint32_t> table_;        // hash slots: position ids
  std::vector<std::uint32_t> firstVertex_;  // one a position id
  std::vector<std::uint32_t> nextVertex_;   // one a vertex: the next of the same position
};

glm::vec3 scaledCross(const WeldedMesh& mesh, const glm::uvec3& t, float scale) {
  const glm::vec3 a = (mesh.positions[t.y] - mesh.positions[t.x]) * scale;
  const glm::vec3 b = (mesh.positions[t.z] - mesh.positions[t.x]) * scale;
  return glm::cross(a, b);
}

// Area-weighted normals. Where they cancel out (mixed winding) or every face is degenerate, the
// normal of the first face that has one, else +z: a normal of no length would shade black.
void computeNormals(WeldedMesh& mesh) {
  const glm::vec3 extent = mesh.box.max - mesh.box.min;
  const float size = glm::max(extent.x, glm::max(extent.y, extent.z));
  const float scale = size > 0.0f && std::isfinite(1.0f / size) ? 1.0f / size : 1.0f;
  double area = 0.0;
  std::vector<glm::vec3>& normals = mesh.normals;
  normals.assign(mesh.positions.size(), glm::vec3(0.0f));
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 cross = scaledCross(mesh, t, scale);
    area += glm::length(cross);
    for (int corner = 0; corner < 3; ++corner) normals[t[corner]] += cross;
  }
  if (!(area > 0.0)) throw InputError("mesh: expected triangles with an area, found none");
  bool missing = false;
  for (glm::vec3& n : normals) {
    const float length = glm::length(n);
    n = length > 1e-30f ? n / length : glm::vec3(0.0f);
    missing |= n == glm::vec3(0.0f);
  }
  if (!missing) return;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 cross = scaledCross(mesh, t, scale);
    const float length = glm::length(cross);
    if (!(length > 1e-30f)) continue;
    for (int corner = 0; corner < 3; ++corner)
      if (normals[t[corner]] == glm::vec3(0.0f)) normals[t[corner]] = cross / length;
  }
  for (glm::vec3& n : normals)
    if (n == glm::vec3(0.0f)) n = glm::vec3(0.0f, 0.0f, 1.0f);
}

}  // namespace

WeldedMesh computeWeldedMesh(const TriangleMesh& mesh) {
  checkMesh(mesh);
  WeldedMesh out;
  out.triangles.resize(mesh.triangles.size());
  {
    Welder welder(mesh, out);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      for (int corner = 0; corner < 3; ++corner)
        out.triangles[i][corner] = welder.vertexOf(mesh.triangles[i][corner], mesh.objects[i]);
  }
  computeNormals(out);
  return out;
}

}  // namespace hlodbench
