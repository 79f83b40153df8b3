#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "hlod/core/aabb.h"
#include "hlod/scene/mesh_reader.h"
#include "hlod/scene/triangle_source.h"

namespace hlodbench {

// How much there is in a mesh, and where.
struct MeshExtent {
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  Aabb box;  // of all vertices, used or not
};

MeshExtent computeExtent(const MeshFile& mesh);

// The triangles of one mesh file, handed out in any piece, as often as wanted. The mesh itself need
// not be in memory.
class MeshSource {
 public:
  virtual ~MeshSource() = default;
  [[nodiscard]] virtual const MeshExtent& extent() const = 0;
  // Fills the corners, as stored, of the triangles from number `first` on. Several threads may call
  // it at once. Throws InputError where the file has become another meanwhile.
  virtual void read(std::uint64_t first, std::span<SceneTriangle> out) const = 0;
  // What it keeps in memory, about.
  [[nodiscard]] virtual std::uint64_t memoryBytes() const = 0;
  // See computeMeanPartSize(); the same wherever the triangles are kept.
  [[nodiscard]] virtual double computePartSize() const = 0;
};

// Where the triangles of a mesh are kept.
enum class MeshPlace {
  kMemory,
  kFile  // of files that allow it (ply_mesh.h): they stay open and are read piece by piece
};

// Opens a mesh file, with the checks and errors of readMeshFile() and the same triangles.
std::unique_ptr<MeshSource> openMesh(const std::filesystem::path& path, MeshPlace place);

}  // namespace hlodbench
