#include "hlod/scene/scene_source.h"

#include <algorithm>
#include <map>
#include <utility>

#include "hlod/scene/courtyard.h"
#include "hlod/scene/part_size.h"
#include "hlod/scene/scene_file.h"
#include "hlod/scene/scene_placing.h"

namespace hlodbench {
namespace {

// The triangles of instances of a few meshes.
class InstanceTriangles final : public TriangleSource {
 public:
  InstanceTriangles(const std::filesystem::path& path, const SceneDescription& scene,
                    const Progress& progress)
      : meshes_(readMeshes(scene, progress)), instances_(placeMeshes(path, scene, meshes_)) {
    for (const InstanceDescription& instance : scene.instances)
      objects_.push_back({instance.name, instance.color});
    for (const PlacedMesh& instance : instances_)
      begins_.push_back(begins_.back() + instance.mesh->triangles.size());
  }

  [[nodiscard]] std::uint64_t triangleCount() const override { return begins_.back(); }
  [[nodiscard]] const std::vector<SceneObject>& objects() const override { return objects_; }

  void read(std::uint64_t first, std::span<SceneTriangle> out) const override {
    while (!out.empty()) {
      const auto after = std::upper_bound(begins_.begin(), begins_.end(), first);
      const auto instance = static_cast<std::uint32_t>(after - begins_.begin()) - 1;
      const std::size_t count = std::min<std::uint64_t>(out.size(), *after - first);
      readInstance(instance, first - begins_[instance], out.first(count));
      out = out.subspan(count);
      first += count;
    }
  }

  [[nodiscard]] std::uint64_t memoryBytes() const override {
    std::uint64_t bytes = 0;
    for (const auto& [key, mesh] : meshes_)
      bytes +=
          mesh.positions.size() * sizeof(glm::vec3) + mesh.triangles.size() * sizeof(glm::uvec3);
    return bytes;
  }

  [[nodiscard]] std::optional<double> computePartSize() const override {
    std::map<const MeshFile*, double> parts;
    for (const auto& [key, mesh] : meshes_)
      parts[&mesh] = static_cast<double>(mesh.triangles.size()) /
                     computeMeanPartSize(mesh.positions, mesh.triangles);
    double all = 0.0;
    for (const PlacedMesh& instance : instances_) all += parts.at(instance.mesh);
    return static_cast<double>(triangleCount()) / all;
  }

 private:
  void readInstance(std::uint32_t number, std::uint64_t first, std::span<SceneTriangle> out) const {
    const PlacedMesh& instance = instances_[number];
    for (std::size_t i = 0; i < out.size(); ++i) {
      const glm::uvec3& t = instance.mesh->triangles[first + i];
      for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3 position(instance.mesh->positions[t[corner]]);
        // Adding 0 makes -0 into 0 and changes nothing else.
        out[i].corners[corner] = glm::vec3(instance.toWorld * glm::dvec4(position, 1.0)) + 0.0f;
      }
      if (instance.mirrored) std::swap(out[i].corners[1], out[i].corners[2]);
      out[i].object = number;
    }
  }

  std::map<std::string, MeshFile> meshes_;
  std::vector<PlacedMesh> instances_;
  std::vector<SceneObject> objects_;
  std::vector<std::uint64_t> begins_{0};  // the first triangle of each instance; one more
};

// The triangles of a generated or bare mesh.
class OwnTriangles final : public TriangleSource {
 public:
  explicit OwnTriangles(TriangleMesh mesh) : mesh_(std::move(mesh)), triangles_(mesh_) {}
  [[nodiscard]] std::uint64_t triangleCount() const override { return triangles_.triangleCount(); }
  [[nodiscard]] const std::vector<SceneObject>& objects() const override {
    return triangles_.objects();
  }
  void read(std::uint64_t first, std::span<SceneTriangle> out) const override {
    triangles_.read(first, out);
  }
  [[nodiscard]] std::uint64_t memoryBytes() const override { return triangles_.memoryBytes(); }
  [[nodiscard]] std::optional<double> computePartSize() const override {
    return triangles_.computePartSize();
  }

 private:
  TriangleMesh mesh_;
  MeshTriangles triangles_;
};

}  // namespace

std::unique_ptr<TriangleSource> openScene(const std::filesystem::path& path,
                                          const Progress& progress) {
  if (path.extension() != ".json")
    return std::make_unique<OwnTriangles>(readScene(path, progress).mesh);
  const SceneDescription scene = readSceneDescription(path);
  if (scene.courtyard) return std::make_unique<OwnTriangles>(readScene(path, progress).mesh);
  return std::make_unique<InstanceTriangles>(path, scene, progress);
}

}  // namespace hlodbench
