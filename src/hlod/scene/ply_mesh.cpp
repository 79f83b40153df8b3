#include "hlod/scene/ply_mesh.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "hlod/core/file_io.h"
#include "hlod/scene/mesh_reader_faults.h"
#include "hlod/scene/part_size.h"
#include "hlod/scene/ply_layout.h"
#include "hlod/scene/ply_vertices.h"

namespace hlodbench {
namespace mesh_reader {
namespace {

constexpr std::uint64_t kPiece = 16384;         // records looked at together
constexpr std::uint64_t kHeadBytes = 1u << 16;  // headers that are longer are read with the rest
constexpr std::string_view kHeadEnd = "\nend_header";

// The header, when it ends within the first bytes.
std::optional<PlyHeader> readHead(int fd, std::uint64_t fileBytes,
                                  const std::filesystem::path& path) {
  FileText head{path.string(), std::string(std::min(fileBytes, kHeadBytes), '\0')};
  readAt(fd, 0, head.bytes.data(), head.bytes.size(), path);
  const std::size_t end = head.bytes.find(kHeadEnd);
  if (end == std::string::npos || head.bytes.find('\n', end + kHeadEnd.size()) == std::string::npos)
    return std::nullopt;
  return readPlyHeader(head, fileBytes);
}

class PlyMesh final : public MeshSource {
 public:
  PlyMesh(Descriptor fd, std::filesystem::path path, const PlyLayout& layout)
      : fd_(std::move(fd)), path_(std::move(path)), named_{path_.string(), {}}, layout_(layout) {
    extent_.vertices = layout_.vertices.count;
    extent_.triangles = layout_.faces.count;
  }
  [[nodiscard]] const MeshExtent& extent() const override { return extent_; }
  void read(std::uint64_t first, std::span<SceneTriangle> out) const override;
  // read() takes less than 3 MiB a thread, for a moment
  [[nodiscard]] std::uint64_t memoryBytes() const override { return 0; }
  [[nodiscard]] double computePartSize() const override;

  // Looks at the whole file, in the order in which readMeshFile() does, so that of several faults
  // the same is found. False: there are larger faces.
  bool check(std::uint64_t fileBytes, bool mayGoOn);

 private:
  // So many bytes of the records from number `first` on.
  void readRecords(const PlyRecords& records, std::uint64_t first, std::uint64_t bytes,
                   std::vector<std::byte>& into) const {
    into.resize(bytes);
    readAt(fd_.get(), records.begin + first * records.size, into.data(), bytes, path_);
  }
  // Calls body(record, number) with the first `count` records as long as it returns true. Whether
  // it always did.
  template <typename Body>
  bool passOver(const PlyRecords& records, std::uint64_t count, Body&& body) const {
    std::vector<std::byte> piece;
    for (std::uint64_t first = 0; first < count; first += kPiece) {
      const std::uint64_t here = std::min(kPiece, count - first);
      readRecords(records, first, here * records.size, piece);
      for (std::uint64_t i = 0; i < here; ++i)
        if (!body(piece.data() + i * records.size, first + i)) return false;
    }
    return true;
  }
  bool checkFaces(std::uint64_t fileBytes) const;
  bool checkFace(const std::byte* face, std::uint64_t number) const;
  void checkVertices();
  void checkArea() const;
  // Of what has been checked already: what fails now is a file that is written to.
  [[nodiscard]] glm::uvec3 cornersAgain(const std::byte* face, std::uint64_t number) const {
    if (!checkFace(face, number)) failOnFile(path_, "changed while it was read");
    return {layout_.index(face, 0), layout_.index(face, 1), layout_.index(face, 2)};
  }
  void checkAgain(const glm::vec3& position) const {
    if (!isFinite(position)) failOnFile(path_, "changed while it was read");
  }
  [[noreturn]] void failInFace(std::uint64_t face) const {
    fail(named_, fmt::format("truncated: the file ends in face {} (from 0) of {}", face,
                             layout_.faces.count));
  }

  Descriptor fd_;
  std::filesystem::path path_;
  FileText named_;  // without its bytes
  PlyLayout layout_;
  MeshExtent extent_;
};

void PlyMesh::read(std::uint64_t first, std::span<SceneTriangle> out) const {
  PlyVertexReader vertices(layout_, fd_.get(), path_);
  std::vector<std::byte> faces;
  std::vector<WantedVertex> wanted;
  while (!out.empty()) {
    const std::size_t count = std::min<std::size_t>(kPiece, out.size());
    readRecords(layout_.faces, first, count * layout_.faces.size, faces);
    wanted.clear();
    for (std::uint32_t i = 0; i < count; ++i) {
      const glm::uvec3 t = cornersAgain(faces.data() + i * layout_.faces.size, first + i);
      for (unsigned corner = 0; corner < 3; ++corner)
        wanted.push_back({t[static_cast<int>(corner)], 3 * i + corner});
    }
    vertices.read(wanted, out.first(count));
    for (const SceneTriangle& triangle : out.first(count))
      for (const glm::vec3& corner : triangle.corners) checkAgain(corner);
    out = out.subspan(count);
    first += count;
  }
}

double PlyMesh::computePartSize() const {
  if (isTooLargeForParts(extent_.vertices, extent_.triangles))
    return static_cast<double>(extent_.triangles);
  std::vector<glm::vec3> positions;
  positions.reserve(extent_.vertices);
  passOver(layout_.vertices, extent_.vertices, [&](const std::byte* vertex, std::uint64_t) {
    positions.push_back(layout_.position(vertex));
    checkAgain(positions.back());
    return true;
  });
  std::vector<glm::uvec3> triangles;
  triangles.reserve(extent_.triangles);
  passOver(layout_.faces, extent_.triangles, [&](const std::byte* face, std::uint64_t number) {
    triangles.push_back(cornersAgain(face, number));
    return true;
  });
  return computeMeanPartSize(positions, triangles);
}

bool PlyMesh::check(std::uint64_t fileBytes, bool mayGoOn) {
  if (!checkFaces(fileBytes)) return false;
  if (!mayGoOn && fileBytes > layout_.faces.end())
    failOnMore(named_, layout_.vertices.count, layout_.faces.count,
               fileBytes - layout_.faces.end());
  checkVertices();
  checkArea();
  return true;
}

bool PlyMesh::checkFaces(std::uint64_t fileBytes) const {
  const PlyRecords& faces = layout_.faces;
  const std::uint64_t bytes = std::min(fileBytes, faces.end()) - faces.begin;
  const std::uint64_t whole = bytes / faces.size;
  const bool areTriangles = passOver(
      faces, whole,
      [&](const std::byte* face, std::uint64_t number) { return checkFace(face, number); });
  if (!areTriangles) return false;
  if (whole == faces.count) return true;
  // the face in which the file ends, maybe behind its corners
  const std::uint64_t rest = bytes - whole * faces.size;
  if (rest < layout_.countSize) failInFace(whole);
  std::vector<std::byte> piece;
  readRecords(faces, whole, rest, piece);
  const std::uint64_t corners = layout_.countCorners(piece.data());
  if (corners > 3) return false;
  if (rest < layout_.listSize(corners)) failInFace(whole);
  checkFace(piece.data(), whole);
  failInFace(whole + 1);
}

// False: it has more than 3 corners.
bool PlyMesh::checkFace(const std::byte* face, std::uint64_t number) const {
  const std::uint32_t corners = layout_.countCorners(face);
  if (corners > 3) return false;
  if (corners < 3) failOnCorners(named_, number, corners);
  for (unsigned corner = 0; corner < 3; ++corner) {
    const std::int32_t index = layout_.index(face, corner);
    // without its sign, a negative one is too large
    if (static_cast<std::uint32_t>(index) >= layout_.vertices.count)
      failOnIndex(named_, number, layout_.vertices.count, index);
  }
  return true;
}

void PlyMesh::checkVertices() {
  const PlyRecords& vertices = layout_.vertices;
  passOver(vertices, vertices.count, [&](const std::byte* vertex, std::uint64_t number) {
    const glm::vec3 position = layout_.position(vertex);
    if (!isFinite(position)) failOnPosition(named_, number, position);
    extent_.box.extend(position);
    return true;
  });
}

void PlyMesh::checkArea() const {
  std::vector<SceneTriangle> piece;
  for (std::uint64_t first = 0; first < extent_.triangles; first += kPiece) {
    piece.resize(std::min(kPiece, extent_.triangles - first));
    read(first, piece);
    for (const SceneTriangle& t : piece)
      if (hasArea(t.corners[0], t.corners[1], t.corners[2])) return;
  }
  failOnArea(named_, extent_.triangles);
}

}  // namespace
}  // namespace mesh_reader

std::unique_ptr<MeshSource> openPlyMesh(const std::filesystem::path& path) {
  namespace reader = mesh_reader;
  if (reader::lowerCase(path.extension().string()) != ".ply") return nullptr;
  // a pipe would have to be waited for
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return nullptr;
  Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (fd.get() < 0 || ::fstat(fd.get(), &status) != 0) return nullptr;
  const auto bytes = static_cast<std::uint64_t>(status.st_size);
  const std::optional<reader::PlyHeader> header = reader::readHead(fd.get(), bytes, path);
  if (!header) return nullptr;
  const std::optional<reader::PlyLayout> layout = reader::computePlyLayout(*header);
  // one without faces has a fault that is not worth finding twice
  if (!layout || layout->faces.count == 0) return nullptr;
  auto mesh = std::make_unique<reader::PlyMesh>(std::move(fd), path, *layout);
  if (!mesh->check(bytes, header->moreElements)) return nullptr;
  return mesh;
}

}  // namespace hlodbench
