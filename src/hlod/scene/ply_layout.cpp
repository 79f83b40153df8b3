#include "hlod/scene/ply_layout.h"

#include <bit>
#include <cstring>

namespace hlodbench::mesh_reader {
namespace {

template <typename T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(value));
  return value;
}

// A list counts with 3 numbers.
std::uint64_t recordSize(const PlyElement& element) {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    const std::uint64_t size = sizeOfPlyType(property.type);
    bytes += property.countType.empty() ? size : sizeOfPlyType(property.countType) + 3 * size;
  }
  return bytes;
}

void findAxes(const PlyElement& vertex, PlyLayout& layout) {
  std::size_t offset = 0;
  for (const PlyProperty& property : vertex.properties) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (property.name == std::string(1, "xyz"[axis]))
        layout.axes[axis] = {offset, property.type == "double"};
    offset += sizeOfPlyType(property.type);
  }
}

}  // namespace

glm::vec3 PlyLayout::position(const std::byte* vertex) const {
  glm::vec3 p;
  for (int i = 0; i < 3; ++i) {
    const std::byte* const at = vertex + axes[i].offset;
    p[i] = axes[i].isDouble ? static_cast<float>(load<double>(at)) : load<float>(at);
  }
  return p;
}

std::uint32_t PlyLayout::countCorners(const std::byte* face) const {
  return countSize == 1 ? load<std::uint8_t>(face) : load<std::uint32_t>(face);
}

std::int32_t PlyLayout::index(const std::byte* face, unsigned corner) const {
  return load<std::int32_t>(face + listSize(corner));
}

std::optional<PlyLayout> computePlyLayout(const PlyHeader& header) {
  if (header.format != "binary_little_endian" || std::endian::native != std::endian::little)
    return std::nullopt;
  PlyLayout layout;
  std::uint64_t at = header.bodyBegin;
  for (const PlyElement& element : header.elements) {
    const PlyRecords records{at, recordSize(element), element.count};
    at = records.end();
    if (element.name == "vertex") {
      layout.vertices = records;
      findAxes(element, layout);
    } else if (element.name == "face") {
      const PlyProperty& corners = element.properties.front();
      if (layout.vertices.size == 0 || sizeOfPlyType(corners.type) != sizeof(std::int32_t))
        return std::nullopt;
      layout.faces = records;
      layout.countSize = sizeOfPlyType(corners.countType);
    }
  }
  return layout;
}

}  // namespace hlodbench::mesh_reader
