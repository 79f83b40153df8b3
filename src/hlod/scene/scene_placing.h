#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/core/progress.h"
#include "hlod/scene/mesh_source.h"
#include "hlod/scene/scene_description.h"

namespace hlodbench {

// A mesh's place in the world.
struct PlacedMesh {
  glm::dmat4 toWorld{1.0};
  bool mirrored = false;  // front faces become back faces; naming the corners backwards undoes that
};

// The meshes of a scene by their names, each read once by read(path).
template <typename Read>
auto readMeshes(const SceneDescription& scene, const Progress& progress, Read&& read) {
  std::map<std::string, decltype(read(std::filesystem::path()))> meshes;
  for (const auto& [key, path] : scene.meshes) {
    const double share = static_cast<double>(meshes.size()) / scene.meshes.size();
    if (progress) progress(fmt::format("reading {}", path.filename().string()), share);
    meshes[key] = read(path);
  }
  if (progress) progress("reading meshes", 1.0);
  return meshes;
}

// Where the scene's instances are, in its order. path: the scene file; meshes: by their names in
// it. Throws InputError where a vertex would get too far out for a float, or when all are too many
// for 32-bit indices.
std::vector<PlacedMesh> placeMeshes(const std::filesystem::path& path,
                                    const SceneDescription& scene,
                                    const std::map<std::string, MeshExtent>& meshes);

}  // namespace hlodbench
