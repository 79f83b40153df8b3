#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/core/progress.h"
#include "hlod/scene/mesh_reader.h"
#include "hlod/scene/scene_description.h"

namespace hlodbench {

// A mesh at its place in the world.
struct PlacedMesh {
  const MeshFile* mesh = nullptr;
  glm::dmat4 toWorld{1.0};
  bool mirrored = false;  // front faces become back faces; naming the corners backwards undoes that
};

// Reads the meshes of a scene, each once. Throws InputError.
std::map<std::string, MeshFile> readMeshes(const SceneDescription& scene, const Progress& progress);

// Where the scene's instances are, in its order. path: the scene file. Throws InputError where a
// vertex would get too far out for a float, or when all are too many for 32-bit indices.
std::vector<PlacedMesh> placeMeshes(const std::filesystem::path& path,
                                    const SceneDescription& scene,
                                    const std::map<std::string, MeshFile>& meshes);

}  // namespace hlodbench
