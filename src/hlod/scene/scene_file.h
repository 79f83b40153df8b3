#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "hlod/core/progress.h"
#include "hlod/scene/triangle_mesh.h"

namespace hlodbench {

// A scene flattened to world-space triangles, and what identifies it.
struct Scene {
  std::string name;
  TriangleMesh mesh;
};

// Reads a scene file (JSON; sessions/scene.schema.json describes it) and the meshes it names,
// whose paths are relative to the scene file. A mesh path may hold ${VARIABLE}s of the environment.
// Throws InputError with the file and the JSON pointer of what is wrong.
Scene readScene(const std::filesystem::path& path, const Progress& progress = {});

// A 64-bit hash (XXH3) of everything the flattened triangles depend on: the scene file's bytes and
// the bytes of every mesh file; it says whether a hierarchy built earlier is still the right one.
std::uint64_t computeSceneHash(const std::filesystem::path& path);

}  // namespace hlodbench
