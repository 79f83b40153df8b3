#include "hlod/scene/mesh_source.h"

#include <utility>

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
