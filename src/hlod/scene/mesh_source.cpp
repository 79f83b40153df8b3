#include "hlod/scene/mesh_source.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "hlod/scene/part_size.h"
#include "hlod/scene/ply_mesh.h"

namespace hlodbench {
namespace {

class MemoryMesh final : public MeshSource {
 public:
  explicit MemoryMesh(MeshFile mesh) : mesh_(std::move(mesh)), extent_(computeExtent(mesh_)) {}
  [[nodiscard]] const MeshExtent& extent() const override { return extent_; }
  void read(std::uint64_t first, std::span<SceneTriangle> out) const override {
    for (std::size_t i = 0; i < out.size(); ++i)
      for (int corner = 0; corner < 3; ++corner)
        out[i].corners[corner] = mesh_.positions[mesh_.triangles[first + i][corner]];
  }
  [[nodiscard]] std::uint64_t memoryBytes() const override {
    return mesh_.positions.size() * sizeof(glm::vec3) + mesh_.triangles.size() * sizeof(glm::uvec3);
  }
  [[nodiscard]] double computePartSize() const override {
    return computeMeanPartSize(mesh_.positions, mesh_.triangles);
  }

 private:
  MeshFile mesh_;
  MeshExtent extent_;
};

}  // namespace

double MeshSource::computePartSize() const {
  const std::uint64_t count = extent().triangles;
  if (count > kMostExaminedTriangles) return static_cast<double>(count);
  std::vector<glm::vec3> corners;
  std::vector<glm::uvec3> triangles;
  std::vector<SceneTriangle> piece;
  for (std::uint64_t first = 0; first < count; first += piece.size()) {
    piece.resize(std::min<std::uint64_t>(16384, count - first));
    read(first, piece);
    for (const SceneTriangle& t : piece) {
      const auto at = static_cast<std::uint32_t>(corners.size());
      corners.insert(corners.end(), std::begin(t.corners), std::end(t.corners));
      triangles.emplace_back(at, at + 1, at + 2);
    }
  }
  return computeMeanPartSize(corners, triangles);
}

MeshExtent computeExtent(const MeshFile& mesh) {
  MeshExtent extent{mesh.positions.size(), mesh.triangles.size(), {}};
  for (const glm::vec3& position : mesh.positions) extent.box.extend(position);
  return extent;
}

std::unique_ptr<MeshSource> openMesh(const std::filesystem::path& path, MeshPlace place) {
  if (place == MeshPlace::kFile)
    if (std::unique_ptr<MeshSource> mesh = openPlyMesh(path)) return mesh;
  return std::make_unique<MemoryMesh>(readMeshFile(path));
}

}  // namespace hlodbench
