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

// Reads PLY (ASCII, binary of both byte orders), OBJ, OFF or STL (ASCII, binary), each also
// gzipped (.gz), into a soup; the name's ending says which. PLY goes through OpenMesh's reader.
// Throws InputError for a missing, truncated or corrupt file, a format that is not known, a vertex
// that is not finite, an index out of range, a mesh with no triangle or with no area.
// One cut cannot be told from a whole file: an ASCII PLY or OFF whose very last number lost digits,
// and an OBJ cut between two lines (OBJ does not say how much there is). A .gz tells even these.
MeshFile readMeshFile(const std::filesystem::path& path);

}  // namespace hlodbench
