#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "hlod/core/progress.h"
#include "hlod/scene/triangle_mesh.h"

namespace hlodbench {

// Raised by one whenever generateCourtyard() makes other triangles from the same options, so that
// hierarchies built before are known to be out of date.
inline constexpr int kCourtyardVersion = 1;

// A scene flattened to world-space triangles, and what identifies it.
struct Scene {
  std::string name;
  TriangleMesh mesh;
};

// Reads a scene file (JSON; sessions/scene.schema.json describes it) and the meshes it names,
// whose paths are relative to the scene file. A mesh path may hold ${VARIABLE}s of the environment,
// and ${VARIABLE:-text} where text stands in for a variable that is not set or empty.
// A path that does not end in .json is read as one mesh: a scene of one instance, as stored.
// y is up in what comes back; transforms are computed in double precision, and a mesh that many
// instances share is read once.
// Throws InputError with the file and the JSON pointer of what is wrong.
Scene readScene(const std::filesystem::path& path, const Progress& progress = {});

// What a mesh that is a scene of its own is called: "bunny" for bunny.ply.gz.
std::string nameBareMesh(const std::filesystem::path& path);

// A 64-bit hash (XXH3) of everything the flattened triangles depend on: the scene file's bytes and
// the bytes of every mesh file (of a generated scene, the generator's version); it says whether a
// hierarchy built earlier is still the right one.
std::uint64_t computeSceneHash(const std::filesystem::path& path);

}  // namespace hlodbench
