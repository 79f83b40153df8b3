#pragma once

#include <filesystem>
#include <memory>

#include "hlod/scene/mesh_source.h"

namespace hlodbench {

// A binary little-endian PLY of triangles, which is too large for memory perhaps: it stays where it
// is and is read piece by piece, by every call of read() that looks at it. It is not mapped,
// because mapped pages count as the program's memory, and because reading says it when the file has
// been cut off meanwhile. Checks the whole file as readMeshFile() does, and throws what that would.
// Null where the file is of another kind, has faces of more than 3 corners, or cannot be opened:
// readMeshFile() is to see to it.
std::unique_ptr<MeshSource> openPlyMesh(const std::filesystem::path& path);

}  // namespace hlodbench
