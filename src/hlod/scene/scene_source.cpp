#include "hlod/scene/scene_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "hlod/scene/courtyard.h"
#include "hlod/scene/mesh_source.h"
#include "hlod/scene/scene_file.h"
#include "hlod/scene/scene_placing.h"

namespace hlodbench {
namespace {

using Meshes = std::map<std::string, std::unique_ptr<MeshSource>>;

// One file each at most, of which a process may have open a limited number.
constexpr std::size_t kMostOpenMeshes = 256;

Meshes openMeshes(const SceneDescription& scene, MeshPlace place, const Progress& progress) {
  if (scene.meshes.size() > kMostOpenMeshes) place = MeshPlace::kMemory;
  return readMeshes(scene, progress,
                    [place](const std::filesystem::path& path) { return openMesh(path, place); });
}

std::map<std::string, MeshExtent> extentsOf(const Meshes& meshes) {
  std::map<std::string, MeshExtent> extents;
  for (const auto& [key, mesh] : meshes) extents[key] = mesh->extent();
  return extents;
}

// The triangles of instances of a few meshes.
class InstanceTriangles final : public TriangleSource {
 public:
  InstanceTriangles(const std::filesystem::path& path, const SceneDescription& scene,
                    MeshPlace place, const Progress& progress)
      : meshes_(openMeshes(scene, place, progress)),
        places_(placeMeshes(path, scene, extentsOf(meshes_))) {
    for (const InstanceDescription& instance : scene.instances) {
      instances_.push_back(meshes_.at(instance.mesh).get());
      objects_.push_back({instance.name, instance.color});
      begins_.push_back(begins_.back() + instances_.back()->extent().triangles);
    }
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
    for (const auto& [key, mesh] : meshes_) bytes += mesh->memoryBytes();
    return bytes;
  }

  [[nodiscard]] double computePartSize() const override {
    std::map<const MeshSource*, double> parts;
    for (const auto& [key, mesh] : meshes_)
      parts[mesh.get()] = static_cast<double>(mesh->extent().triangles) / mesh->computePartSize();
    double all = 0.0;
    for (const MeshSource* mesh : instances_) all += parts.at(mesh);
    return static_cast<double>(triangleCount()) / all;
  }

 private:
  void readInstance(std::uint32_t number, std::uint64_t first, std::span<SceneTriangle> out) const {
    instances_[number]->read(first, out);
    const PlacedMesh& place = places_[number];
    for (SceneTriangle& triangle : out) {
      for (glm::vec3& corner : triangle.corners)
        // Adding 0 makes -0 into 0 and changes nothing else.
        corner = glm::vec3(place.toWorld * glm::dvec4(glm::dvec3(corner), 1.0)) + 0.0f;
      if (place.mirrored) std::swap(triangle.corners[1], triangle.corners[2]);
      triangle.object = number;
    }
  }

  Meshes meshes_;
  std::vector<PlacedMesh> places_;            // of the instances
  std::vector<const MeshSource*> instances_;  // their meshes
  std::vector<SceneObject> objects_;
  std::vector<std::uint64_t> begins_{0};  // the first triangle of each instance; one more
};

// The triangles of a mesh that is a scene of its own, as stored.
class BareTriangles final : public TriangleSource {
 public:
  BareTriangles(const std::filesystem::path& path, MeshPlace place, const Progress& progress) {
    if (progress) progress(fmt::format("reading {}", path.filename().string()), 0.0);
    mesh_ = openMesh(path, place);
    objects_.push_back({nameBareMesh(path), choosePaletteColor(0)});
    if (progress) progress("reading meshes", 1.0);
  }
  [[nodiscard]] std::uint64_t triangleCount() const override { return mesh_->extent().triangles; }
  [[nodiscard]] const std::vector<SceneObject>& objects() const override { return objects_; }
  void read(std::uint64_t first, std::span<SceneTriangle> out) const override {
    mesh_->read(first, out);
    for (SceneTriangle& triangle : out) {
      for (glm::vec3& corner : triangle.corners) corner += 0.0f;  // -0 becomes 0
      triangle.object = 0;
    }
  }
  [[nodiscard]] std::uint64_t memoryBytes() const override { return mesh_->memoryBytes(); }
  [[nodiscard]] double computePartSize() const override { return mesh_->computePartSize(); }

 private:
  std::unique_ptr<MeshSource> mesh_;
  std::vector<SceneObject> objects_;
};

// The triangles of a generated mesh.
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
  [[nodiscard]] double computePartSize() const override { return triangles_.computePartSize(); }

 private:
  TriangleMesh mesh_;
  MeshTriangles triangles_;
};

}  // namespace

std::unique_ptr<TriangleSource> openScene(const std::filesystem::path& path, MeshPlace place,
                                          const Progress& progress) {
  if (path.extension() != ".json") return std::make_unique<BareTriangles>(path, place, progress);
  const SceneDescription scene = readSceneDescription(path);
  if (scene.courtyard) return std::make_unique<OwnTriangles>(readScene(path, progress).mesh);
  return std::make_unique<InstanceTriangles>(path, scene, place, progress);
}

}  // namespace hlodbench
