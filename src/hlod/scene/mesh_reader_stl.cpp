// STL, ASCII and binary. OpenMesh reads it too, but it leaves out triangles with two equal corners
// and turns a corner that is not a number into some other vertex, because it merges corners.

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iterator>

#include "hlod/scene/mesh_reader_parts.h"

namespace hlodbench::mesh_reader {
namespace {

constexpr std::size_t kHeaderBytes = 84;    // 80 of any text, then the number of triangles
constexpr std::size_t kTriangleBytes = 50;  // normal, three corners, two bytes nobody uses
constexpr std::size_t kNormalBytes = 12;

std::uint32_t readLittleEndian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

void addCorners(const glm::vec3 (&corners)[3], MeshFile& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners, corners + 3);
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

MeshFile readBinary(const FileText& file, std::uint32_t count) {
  MeshFile mesh;
  mesh.positions.reserve(std::size_t{count} * 3);
  mesh.triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* at = file.bytes.data() + kHeaderBytes + i * kTriangleBytes + kNormalBytes;
    glm::vec3 corners[3];
    for (int k = 0; k < 9; ++k)
      corners[k / 3][k % 3] = std::bit_cast<float>(readLittleEndian(at + k * 4));
    addCorners(corners, mesh);
  }
  return mesh;
}

bool sameWord(std::string_view word, std::string_view lowerCase) {
  return word.size() == lowerCase.size() &&
         std::equal(word.begin(), word.end(), lowerCase.begin(),
                    [](char a, char b) { return a == b || (a >= 'A' && a <= 'Z' && a + 32 == b); });
}

// Which statement of ASCII STL may follow: each has one place only.
MeshFile readAscii(const FileText& file) {
  enum class In { kFile, kSolid, kFacet, kLoop, kFacetEnd } state = In::kFile;
  struct Step {
    const char* keyword;
    In from;
    In to;
  };
  constexpr Step kSteps[] = {
      {"solid", In::kFile, In::kSolid},      {"facet", In::kSolid, In::kFacet},
      {"outer", In::kFacet, In::kLoop},      {"vertex", In::kLoop, In::kLoop},
      {"endloop", In::kLoop, In::kFacetEnd}, {"endfacet", In::kFacetEnd, In::kSolid},
      {"endsolid", In::kSolid, In::kFile}};
  MeshFile mesh;
  glm::vec3 corners[3];
  int cornerCount = 0;
  Lines lines(file.bytes);
  for (std::string_view line; lines.next(line);) {
    const std::string_view keyword = takeWord(line);
    if (keyword.empty()) continue;
    const Step* step = std::find_if(std::begin(kSteps), std::end(kSteps), [&](const Step& s) {
      return s.from == state && sameWord(keyword, s.keyword);
    });
    if (step == std::end(kSteps))
      failAtLine(file, lines.number(),
                 fmt::format("'{}' is not expected here", keyword.substr(0, 40)));
    if (sameWord(keyword, "vertex")) {
      if (cornerCount == 3) failAtLine(file, lines.number(), "expected 3 corners, found a fourth");
      corners[cornerCount++] = takePoint(file, lines, line);
    } else if (sameWord(keyword, "endloop")) {
      if (cornerCount != 3)
        failAtLine(file, lines.number(), fmt::format("expected 3 corners, found {}", cornerCount));
      addCorners(corners, mesh);
      cornerCount = 0;
    }
    state = step->to;
  }
  if (state != In::kFile) fail(file, "truncated: expected endsolid before the end");
  return mesh;
}

}  // namespace

MeshFile readStl(const FileText& file) {
  // Many binary files begin with "solid" too, so a size that fits decides first.
  const std::size_t size = file.bytes.size();
  const std::uint32_t count = size >= kHeaderBytes ? readLittleEndian(file.bytes.data() + 80) : 0;
  const std::size_t expected = kHeaderBytes + std::size_t{count} * kTriangleBytes;
  if (size >= kHeaderBytes && size == expected) return readBinary(file, count);
  std::string_view start = std::string_view(file.bytes).substr(0, kHeaderBytes);
  start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
  if (start.size() >= 5 && sameWord(start.substr(0, 5), "solid")) return readAscii(file);
  fail(file,
       size < kHeaderBytes
           ? fmt::format("truncated: expected at least {} bytes, found {}", kHeaderBytes, size)
           : fmt::format("truncated or corrupt: {} triangles take {} bytes, found {}", count,
                         expected, size));
}

}  // namespace hlodbench::mesh_reader
