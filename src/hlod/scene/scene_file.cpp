#include "hlod/scene/scene_file.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <memory>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "hlod/core/error.h"
#include "hlod/scene/scene_placing.h"

namespace hlodbench {
namespace {

bool isSceneFile(const std::filesystem::path& path) {
  return path.extension() == ".json";
}

// Adds one instance's triangles.
void addInstance(const MeshFile& mesh, const PlacedMesh& instance, TriangleMesh& scene) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const glm::vec3& position : mesh.positions)
    scene.positions.emplace_back(instance.toWorld * glm::dvec4(glm::dvec3(position), 1.0));
  for (const glm::uvec3& t : mesh.triangles)
    scene.triangles.push_back(first + (instance.mirrored ? glm::uvec3(t.x, t.z, t.y) : t));
  const auto object = static_cast<std::uint32_t>(scene.objectTable.size() - 1);
  scene.objects.resize(scene.triangles.size(), object);
}

Scene readBareMesh(const std::filesystem::path& path, const Progress& progress) {
  if (progress) progress(fmt::format("reading {}", path.filename().string()), 0.0);
  MeshFile mesh = readMeshFile(path);
  Scene scene;
  scene.name = nameBareMesh(path);
  scene.mesh.objectTable.push_back({scene.name, choosePaletteColor(0)});
  scene.mesh.objects.assign(mesh.triangles.size(), 0);
  scene.mesh.positions = std::move(mesh.positions);
  scene.mesh.triangles = std::move(mesh.triangles);
  if (progress) progress("reading meshes", 1.0);
  return scene;
}

// Feeds a hash with pieces, each with its length, so that no two lists of pieces look alike.
class SceneHasher {
 public:
  SceneHasher() : state_(XXH3_createState(), XXH3_freeState) { XXH3_64bits_reset(state_.get()); }

  void addFile(const std::filesystem::path& path) {
    constexpr std::size_t kChunk = 1u << 20;
    // a device may never end
    if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path))
      throw InputError(
          fmt::format("{}: expected a file, found a folder or a device", path.string()));
    std::ifstream in(path, std::ios::binary);
    std::vector<char> chunk(kChunk);
    std::uint64_t size = 0;
    while (in) {
      in.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
      const auto got = static_cast<std::size_t>(in.gcount());
      XXH3_64bits_update(state_.get(), chunk.data(), got);
      size += got;
    }
    if (!in.eof()) throw InputError(fmt::format("{}: cannot be read", path.string()));
    addNumber(size);
  }
  void addNumber(std::uint64_t number) {
    std::array<unsigned char, 8> bytes;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<unsigned char>(number >> (8 * i));
    XXH3_64bits_update(state_.get(), bytes.data(), bytes.size());
  }
  [[nodiscard]] std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

}  // namespace

std::string nameBareMesh(const std::filesystem::path& path) {
  const std::string name = path.stem().string();
  return name.substr(0, name.find('.', 1));
}

Scene readScene(const std::filesystem::path& path, const Progress& progress) {
  if (!isSceneFile(path)) return readBareMesh(path, progress);
  const SceneDescription description = readSceneDescription(path);
  if (description.courtyard) {
    if (progress) progress("generating the courtyard", 0.0);
    return {description.name, generateCourtyard(*description.courtyard)};
  }
  const auto meshes = readMeshes(description, progress, readMeshFile);
  std::map<std::string, MeshExtent> extents;
  for (const auto& [key, mesh] : meshes) extents[key] = computeExtent(mesh);
  Scene scene{description.name, {}};
  const std::vector<PlacedMesh> placed = placeMeshes(path, description, extents);
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  for (const InstanceDescription& instance : description.instances) {
    vertices += extents.at(instance.mesh).vertices;
    triangles += extents.at(instance.mesh).triangles;
  }
  scene.mesh.positions.reserve(vertices);
  scene.mesh.triangles.reserve(triangles);
  scene.mesh.objects.reserve(triangles);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const InstanceDescription& instance = description.instances[i];
    scene.mesh.objectTable.push_back({instance.name, instance.color});
    addInstance(meshes.at(instance.mesh), placed[i], scene.mesh);
  }
  return scene;
}

std::uint64_t computeSceneHash(const std::filesystem::path& path) {
  SceneHasher hasher;
  if (!isSceneFile(path)) {
    if (!std::filesystem::exists(path))
      throw InputError(fmt::format("{}: no such file", path.string()));
    hasher.addFile(path);
    return hasher.digest();
  }
  const SceneDescription description = readSceneDescription(path);
  hasher.addFile(path);
  if (description.courtyard) hasher.addNumber(kCourtyardVersion);
  for (const auto& [key, meshPath] : description.meshes) hasher.addFile(meshPath);
  return hasher.digest();
}

}  // namespace hlodbench
