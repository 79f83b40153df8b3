#pragma once

// Where things are in a binary PLY of triangles; nobody but the readers of PLY includes this.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "hlod/scene/mesh_reader_ply_header.h"

namespace hlodbench::mesh_reader {

// Records of one size behind each other; in bytes of the file.
struct PlyRecords {
  std::uint64_t begin = 0;
  std::uint64_t size = 0;  // of one record
  std::uint64_t count = 0;
  [[nodiscard]] std::uint64_t end() const { return begin + size * count; }
};

struct PlyLayout {
  struct Axis {
    std::size_t offset = 0;  // in the vertex's record
    bool isDouble = false;
  };

  PlyRecords vertices;
  std::array<Axis, 3> axes;
  PlyRecords faces;           // if all have 3 corners, which only they can say
  std::size_t countSize = 0;  // bytes of the number of corners, with which a face begins

  [[nodiscard]] glm::vec3 position(const std::byte* vertex) const;
  [[nodiscard]] std::uint32_t countCorners(const std::byte* face) const;
  // corner: 0 to 2
  [[nodiscard]] std::int32_t index(const std::byte* face, unsigned corner) const;
  // Bytes of a face's record up to the last of so many corners.
  [[nodiscard]] std::uint64_t listSize(std::uint64_t corners) const {
    return countSize + corners * sizeof(std::int32_t);
  }
};

// Nothing where records are not of one size, or of a kind that is seldom seen: not in the byte
// order of this machine, faces before vertices, indices that have not 32 bits.
std::optional<PlyLayout> computePlyLayout(const PlyHeader& header);

}  // namespace hlodbench::mesh_reader
