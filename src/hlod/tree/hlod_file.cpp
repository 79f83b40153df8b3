#include "hlod/tree/hlod_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>

#include "hlod/core/file_io.h"
#include "hlod/tree/hlod_layout.h"

namespace hlodbench {
namespace {

std::vector<SceneObject> unpackObjects(const std::string& bytes, std::uint64_t count,
                                       const std::filesystem::path& path) {
  std::vector<SceneObject> objects;
  std::size_t at = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    SceneObject object;
    std::uint32_t length = 0;
    constexpr std::size_t kFixed = sizeof(object.color) + sizeof(length);
    if (bytes.size() - at < kFixed) failOnFile(path, "object table cut short");
    std::memcpy(&object.color, bytes.data() + at, sizeof(object.color));
    std::memcpy(&length, bytes.data() + at + sizeof(object.color), sizeof(length));
    at += kFixed;
    if (bytes.size() - at < length) failOnFile(path, "object table cut short");
    object.name.assign(bytes, at, length);
    at += length;
    objects.push_back(std::move(object));
  }
  if (at != bytes.size()) failOnFile(path, "object table too long");
  return objects;
}

Node unpackNode(const StoredNode& s) {
  Node n;
  n.box = s.box;
  n.error = s.error;
  n.parent = s.parent;
  n.firstChild = s.firstChild;
  n.childCount = s.childCount;
  n.level = s.level;
  n.geometryOffset = s.geometryOffset;
  n.geometryHash = s.geometryHash;
  n.vertexCount = s.vertexCount;
  n.indexCount = s.indexCount;
  n.flags = s.flags;
  return n;
}

// Whether count things of `size` bytes from offset on lie within the file.
bool liesWithin(const HlodHeader& header, std::uint64_t offset, std::uint64_t count,
                std::uint64_t size) {
  return offset <= header.fileBytes && count <= (header.fileBytes - offset) / size;
}

void checkSections(const HlodHeader& h, std::uint64_t fileBytes,
                   const std::filesystem::path& path) {
  if (fileBytes != h.fileBytes)
    failOnFile(path, fmt::format("truncated or damaged: expected {} bytes, found {}", h.fileBytes,
                                 fileBytes));
  constexpr std::uint64_t kLeastObject = 16;  // the fixed part
  if (!liesWithin(h, h.optionsOffset, h.optionsBytes, 1) ||
      !liesWithin(h, h.objectsOffset, h.objectsBytes, 1) ||
      !liesWithin(h, h.nodesOffset, h.nodes, sizeof(StoredNode)) ||
      !liesWithin(h, h.geometryOffset, h.geometryBytes, 1) ||
      h.geometryOffset % kBlockAlignment != 0 || h.optionsBytes > kMaxHlodOptions ||
      h.objects > h.objectsBytes / kLeastObject)
    failOnFile(path, "damaged: impossible sizes in its header");
}

// Reads and checks the header and the options.
HlodHeader readHeader(int fd, const std::filesystem::path& path, HlodFileInfo& info) {
  struct stat status {};
  if (fd < 0) failOnFile(path, fmt::format("cannot open: {}", systemReason()));
  if (::fstat(fd, &status) != 0) failOnFile(path, fmt::format("cannot read: {}", systemReason()));
  if (!S_ISREG(status.st_mode)) failOnFile(path, "not a file");
  const auto fileBytes = static_cast<std::uint64_t>(status.st_size);
  HlodHeader header{};
  // those of version 1 were shorter
  constexpr std::uint64_t kShortest = 88;
  if (fileBytes < kShortest)
    failOnFile(path,
               fmt::format("not a hierarchy file: {} bytes are too few for a header", fileBytes));
  readAt(fd, 0, &header, std::min<std::uint64_t>(fileBytes, sizeof(header)), path);
  if (std::memcmp(header.magic, kHlodMagic, sizeof(kHlodMagic)) != 0)
    failOnFile(path, "not a hierarchy file: it does not begin with HLODTREE");
  if (header.version != kHlodFileVersion)
    failOnFile(path, fmt::format("expected format version {}, found {}", kHlodFileVersion,
                                 header.version));
  checkSections(header, fileBytes, path);
  info.options.resize(header.optionsBytes);
  readAt(fd, header.optionsOffset, info.options.data(), info.options.size(), path);
  if (header.headerHash != computeHeaderHash(header, info.options))
    failOnFile(path, "damaged: the header's checksum does not match");
  info.sceneHash = header.sceneHash;
  info.version = header.version;
  info.contentHash = header.contentHash;
  return header;
}

}  // namespace

Hierarchy readHlodFile(const std::filesystem::path& path, HlodFileInfo* info) {
  HlodFileInfo own;
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  const HlodHeader header = readHeader(fd.get(), path, own);
  HlodTables tables;
  tables.options = own.options;
  tables.nodes.resize(header.nodes);
  readAt(fd.get(), header.nodesOffset, tables.nodes.data(), header.nodes * sizeof(StoredNode),
         path);
  tables.objects.resize(header.objectsBytes);
  readAt(fd.get(), header.objectsOffset, tables.objects.data(), tables.objects.size(), path);
  if (computeContentHash(header, tables) != header.contentHash)
    failOnFile(path, "damaged: the checksum of its tables does not match");
  Hierarchy out;
  out.inputTriangles = header.inputTriangles;
  out.objects = unpackObjects(tables.objects, header.objects, path);
  out.geometry =
      GeometrySection(std::make_shared<const FileMapping>(fd.get(), header.fileBytes, path),
                      header.geometryOffset, header.geometryBytes);
  out.nodes.reserve(tables.nodes.size());
  for (const StoredNode& stored : tables.nodes) {
    out.nodes.push_back(unpackNode(stored));
    if (!isGeometryInRange(out, out.nodes.back()))
      failOnFile(path, fmt::format("node {}: geometry out of range", out.nodes.size() - 1));
  }
  if (info != nullptr) *info = own;
  return out;
}

HlodFileInfo readHlodFileInfo(const std::filesystem::path& path) {
  HlodFileInfo info;
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  readHeader(fd.get(), path, info);
  return info;
}

bool isOtherHlodVersion(const std::filesystem::path& path) {
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct {
    char magic[8];
    std::uint32_t version;
  } start{};
  constexpr std::size_t kBytes = sizeof(start.magic) + sizeof(start.version);
  return fd.get() >= 0 && ::read(fd.get(), &start, kBytes) == kBytes &&
         std::memcmp(start.magic, kHlodMagic, sizeof(kHlodMagic)) == 0 &&
         start.version != kHlodFileVersion;
}

}  // namespace hlodbench
