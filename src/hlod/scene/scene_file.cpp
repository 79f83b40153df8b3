#include "hlod/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "hlod/core/aabb.h"
#include "hlod/core/error.h"
#include "hlod/scene/mesh_reader.h"
#include "hlod/scene/scene_description.h"

namespace hlodbench {
namespace {

bool isSceneFile(const std::filesystem::path& path) {
  return path.extension() == ".json";
}

// Centre of the mesh's box to the origin, its lowest point to the ground, its largest extent to 1.
glm::dmat4 computeNormalizing(const MeshFile& mesh, int upAxis) {
  Aabb box;
  for (const glm::vec3& position : mesh.positions) box.extend(position);
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

// Adds one instance's triangles; false when a vertex gets too far out for a float.
bool addInstance(const MeshFile& mesh, const glm::dmat4& toWorld, TriangleMesh& scene) {
  const auto first = static_cast<std::uint32_t>(scene.positions.size());
  for (const glm::vec3& position : mesh.positions) {
    const glm::vec3 placed(toWorld * glm::dvec4(glm::dvec3(position), 1.0));
    if (!std::isfinite(placed.x) || !std::isfinite(placed.y) || !std::isfinite(placed.z))
      return false;
    scene.positions.push_back(placed);
  }
  // A mirroring turns front faces into back faces; naming the corners backwards undoes that.
  const bool mirrored = glm::determinant(glm::dmat3(toWorld)) < 0.0;
  for (const glm::uvec3& t : mesh.triangles)
    scene.triangles.push_back(first + (mirrored ? glm::uvec3(t.x, t.z, t.y) : t));
  const auto object = static_cast<std::uint32_t>(scene.objectTable.size() - 1);
  scene.objects.resize(scene.triangles.size(), object);
  return true;
}

Scene readBareMesh(const std::filesystem::path& path, const Progress& progress) {
  if (progress) progress(fmt::format("reading {}", path.filename().string()), 0.0);
  MeshFile mesh = readMeshFile(path);
  Scene scene;
  scene.name = path.stem().string();
  scene.name = scene.name.substr(0, scene.name.find('.', 1));
  scene.mesh.objectTable.push_back({scene.name, choosePaletteColor(0)});
  scene.mesh.objects.assign(mesh.triangles.size(), 0);
  scene.mesh.positions = std::move(mesh.positions);
  scene.mesh.triangles = std::move(mesh.triangles);
  if (progress) progress("reading meshes", 1.0);
  return scene;
}

std::map<std::string, MeshFile> readMeshes(const SceneDescription& scene,
                                           const Progress& progress) {
  std::map<std::string, MeshFile> meshes;
  for (const auto& [key, path] : scene.meshes) {
    const double share = static_cast<double>(meshes.size()) / scene.meshes.size();
    if (progress) progress(fmt::format("reading {}", path.filename().string()), share);
    meshes[key] = readMeshFile(path);
  }
  if (progress) progress("reading meshes", 1.0);
  return meshes;
}

// Makes room for all instances at once; throws when 32-bit indices do not reach.
void reserveScene(const std::filesystem::path& path, const SceneDescription& description,
                  const std::map<std::string, MeshFile>& meshes, TriangleMesh& scene) {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  for (const InstanceDescription& instance : description.instances) {
    vertices += meshes.at(instance.mesh).positions.size();
    triangles += meshes.at(instance.mesh).triangles.size();
    if (std::max(vertices, triangles) > std::numeric_limits<std::uint32_t>::max())
      throw InputError(
          fmt::format("{}: {}: expected fewer than 2^32 vertices and triangles up to "
                      "here, found {} and {}",
                      path.string(), instance.pointer, vertices, triangles));
  }
  scene.positions.reserve(vertices);
  scene.triangles.reserve(triangles);
  scene.objects.reserve(triangles);
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

Scene readScene(const std::filesystem::path& path, const Progress& progress) {
  if (!isSceneFile(path)) return readBareMesh(path, progress);
  const SceneDescription description = readSceneDescription(path);
  if (description.courtyard) {
    if (progress) progress("generating the courtyard", 0.0);
    return {description.name, generateCourtyard(*description.courtyard)};
  }
  const std::map<std::string, MeshFile> meshes = readMeshes(description, progress);
  Scene scene{description.name, {}};
  reserveScene(path, description, meshes, scene.mesh);
  const glm::dmat4 upright = computeUprighting(description.upAxis);
  for (const InstanceDescription& instance : description.instances) {
    const MeshFile& mesh = meshes.at(instance.mesh);
    glm::dmat4 toWorld = upright * instance.placing;
    if (instance.normalize) toWorld *= computeNormalizing(mesh, description.upAxis);
    scene.mesh.objectTable.push_back({instance.name, instance.color});
    if (!addInstance(mesh, toWorld, scene.mesh))
      throw InputError(
          fmt::format("{}: {}: expected finite coordinates, found a vertex that its "
                      "transform puts too far out for a 32-bit float",
                      path.string(), instance.pointer));
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
