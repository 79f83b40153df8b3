#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <glm/glm.hpp>

namespace hlodbench {

// The triangles of one mesh file, as stored: no face is dropped or welded.
struct MeshFile {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  std::uint64_t polygonsSplit = 0;  // faces of more than 3 corners, cut into fans
};

// Reads PLY (ASCII, binary of both byte orders), OBJ, OFF or STL, each also gzipped (.gz),
// through OpenMesh's readers into a soup.
// Throws InputError for a missing, truncated or corrupt file, a format that is not known, a vertex
// that is not finite, an index out of range, a mesh with no triangle or with no area.
MeshFile readMeshFile(const std::filesystem::path& path);

}  // namespace hlodbench
