#pragma once

// Vertices of a PLY that stays in its file; nobody but the readers of PLY includes this.

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "hlod/scene/ply_layout.h"
#include "hlod/scene/triangle_source.h"

namespace hlodbench::mesh_reader {

// A corner that wants its vertex's position.
struct WantedVertex {
  std::uint32_t vertex = 0;
  std::uint32_t corner = 0;  // 3 times its triangle's number and 0 to 2
};

// Fetches the vertices that some triangles use. Neighbours in a mesh mostly are neighbours in its
// file; so their whole range is read, or where that is too long, the ranges of its halves.
class PlyVertexReader {
 public:
  // All must live as long. fd: the open file; path: what errors call it.
  PlyVertexReader(const PlyLayout& layout, int fd, const std::filesystem::path& path)
      : layout_(layout), fd_(fd), path_(path) {}

  // Fills the wanted corners of `out`, which must not be empty, and reorders `wanted`. Throws
  // InputError where the file ends too early.
  void read(std::span<WantedVertex> wanted, std::span<SceneTriangle> out);

 private:
  const PlyLayout& layout_;
  int fd_;
  const std::filesystem::path& path_;
  std::vector<std::byte> window_;
};

}  // namespace hlodbench::mesh_reader
