#include "hlod/tree/hlod_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>

#include "hlod/core/atomic_file.h"
#include "hlod/tree/file_io.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace hlodbench {
namespace {

static_assert(std::endian::native == std::endian::little, "the file holds the machine's own bytes");
static_assert(std::is_trivially_copyable_v<Node> && std::is_trivially_copyable_v<Vertex>);

constexpr char kMagic[8] = {'H', 'L', 'O', 'D', 'T', 'R', 'E', 'E'};
constexpr std::uint64_t kMaxOptions = 65536;

// The file: header, options, objects, nodes, vertices, indices, nothing else. Objects are their
// colour (12 bytes), the length of the name (4) and the name.
struct Header {
  char magic[8];
  std::uint32_t version;
  std::uint32_t optionsBytes;
  std::uint64_t contentHash;  // XXH3-64 of the file with this field as 0 and headerHash as 0
  std::uint64_t headerHash;   // XXH3-64 of the header and the options with this field as 0
  std::uint64_t sceneHash;
  std::uint64_t inputTriangles;
  std::uint64_t objects;
  std::uint64_t objectBytes;
  std::uint64_t nodes;
  std::uint64_t vertices;
  std::uint64_t indices;
};
static_assert(sizeof(Header) == 88);

// A node as stored: no padding, so that equal hierarchies make equal bytes.
struct StoredNode {
  Aabb box;
  float error;
  std::uint32_t parent, firstChild, childCount, level, vertexCount, indexCount;
  std::uint32_t reserved;
  std::uint64_t firstVertex, firstIndex;
};
static_assert(sizeof(StoredNode) == 72);

class Hasher {
 public:
  Hasher() : state_(XXH3_createState(), XXH3_freeState) { XXH3_64bits_reset(state_.get()); }
  void add(const void* data, std::size_t bytes) { XXH3_64bits_update(state_.get(), data, bytes); }
  [[nodiscard]] std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

 private:
  std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state_;
};

std::uint64_t computeHeaderHash(Header header, const std::string& options) {
  header.headerHash = 0;
  Hasher hasher;
  hasher.add(&header, sizeof(header));
  hasher.add(options.data(), options.size());
  return hasher.digest();
}

void startContentHash(Hasher& hasher, Header header, const std::string& options) {
  header.headerHash = 0;
  header.contentHash = 0;
  hasher.add(&header, sizeof(header));
  hasher.add(options.data(), options.size());
}

// Calls fn(data, bytes) for the blocks after the options, in the order of the file.
template <typename Fn>
void forEachBlock(const std::string& objects, const std::vector<StoredNode>& nodes,
                  const Hierarchy& h, Fn&& fn) {
  fn(objects.data(), objects.size());
  fn(nodes.data(), nodes.size() * sizeof(StoredNode));
  fn(h.vertices.data(), h.vertices.size() * sizeof(Vertex));
  fn(h.indices.data(), h.indices.size() * sizeof(std::uint32_t));
}

std::string packObjects(const std::vector<SceneObject>& objects) {
  std::string bytes;
  for (const SceneObject& object : objects) {
    const auto length = static_cast<std::uint32_t>(object.name.size());
    bytes.append(reinterpret_cast<const char*>(&object.color), sizeof(object.color));
    bytes.append(reinterpret_cast<const char*>(&length), sizeof(length));
    bytes.append(object.name);
  }
  return bytes;
}

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

StoredNode packNode(const Node& n) {
  return {n.box,         n.error,      n.parent, n.firstChild,  n.childCount, n.level,
          n.vertexCount, n.indexCount, 0,        n.firstVertex, n.firstIndex};
}

Node unpackNode(const StoredNode& s) {
  Node n;
  n.box = s.box;
  n.error = s.error;
  n.parent = s.parent;
  n.firstChild = s.firstChild;
  n.childCount = s.childCount;
  n.level = s.level;
  n.firstVertex = s.firstVertex;
  n.vertexCount = s.vertexCount;
  n.firstIndex = s.firstIndex;
  n.indexCount = s.indexCount;
  return n;
}

Header makeHeader(const Hierarchy& h, const HlodFileInfo& info, std::size_t objectBytes) {
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof(kMagic));
  header.version = kHlodFileVersion;
  header.optionsBytes = static_cast<std::uint32_t>(info.options.size());
  header.sceneHash = info.sceneHash;
  header.inputTriangles = h.inputTriangles;
  header.objects = h.objects.size();
  header.objectBytes = objectBytes;
  header.nodes = h.nodes.size();
  header.vertices = h.vertices.size();
  header.indices = h.indices.size();
  return header;
}

// Adds count * size to total; false when that does not fit, or is over any file's size.
bool addBytes(std::uint64_t& total, std::uint64_t count, std::uint64_t size) {
  constexpr std::uint64_t kLimit = std::uint64_t{1} << 62;
  if (count > kLimit / size || total + count * size > kLimit) return false;
  total += count * size;
  return true;
}

void checkSizes(const Header& header, std::uint64_t fileBytes, const std::filesystem::path& path) {
  std::uint64_t wanted = sizeof(Header);
  const bool possible = addBytes(wanted, header.optionsBytes, 1) &&
                        addBytes(wanted, header.objectBytes, 1) &&
                        addBytes(wanted, header.nodes, sizeof(StoredNode)) &&
                        addBytes(wanted, header.vertices, sizeof(Vertex)) &&
                        addBytes(wanted, header.indices, sizeof(std::uint32_t));
  if (!possible) failOnFile(path, "damaged: impossible sizes in its header");
  if (fileBytes != wanted)
    failOnFile(path,
               fmt::format("truncated or damaged: expected {} bytes, found {}", wanted, fileBytes));
}

// Reads and checks the header and the options; leaves fd behind them.
Header readHeader(int fd, const std::filesystem::path& path, HlodFileInfo& info) {
  struct stat status {};
  if (fd < 0) failOnFile(path, fmt::format("cannot open: {}", systemReason()));
  if (::fstat(fd, &status) != 0) failOnFile(path, fmt::format("cannot read: {}", systemReason()));
  if (!S_ISREG(status.st_mode)) failOnFile(path, "not a file");
  const auto fileBytes = static_cast<std::uint64_t>(status.st_size);
  Header header{};
  if (fileBytes < sizeof(Header))
    failOnFile(path,
               fmt::format("not a hierarchy file: {} bytes are too few for a header", fileBytes));
  readAll(fd, &header, sizeof(header), path);
  if (std::memcmp(header.magic, kMagic, sizeof(kMagic)) != 0)
    failOnFile(path, "not a hierarchy file: it does not begin with HLODTREE");
  if (header.version != kHlodFileVersion)
    failOnFile(path, fmt::format("expected format version {}, found {}", kHlodFileVersion,
                                 header.version));
  if (header.optionsBytes > kMaxOptions)
    failOnFile(path, "damaged: impossible sizes in its header");
  checkSizes(header, fileBytes, path);
  info.options.resize(header.optionsBytes);
  readAll(fd, info.options.data(), info.options.size(), path);
  if (header.headerHash != computeHeaderHash(header, info.options))
    failOnFile(path, "damaged: the header's checksum does not match");
  info.sceneHash = header.sceneHash;
  info.version = header.version;
  info.contentHash = header.contentHash;
  return header;
}

}  // namespace

void writeHlodFile(const std::filesystem::path& path, const Hierarchy& hierarchy,
                   HlodFileInfo& info) {
  if (info.options.size() > kMaxOptions)
    failOnFile(path, fmt::format("expected options of at most {} bytes, found {}", kMaxOptions,
                                 info.options.size()));
  const std::string objects = packObjects(hierarchy.objects);
  std::vector<StoredNode> nodes;
  nodes.reserve(hierarchy.nodes.size());
  for (const Node& node : hierarchy.nodes) nodes.push_back(packNode(node));
  Header header = makeHeader(hierarchy, info, objects.size());
  Hasher hasher;
  startContentHash(hasher, header, info.options);
  forEachBlock(objects, nodes, hierarchy,
               [&](const void* data, std::size_t bytes) { hasher.add(data, bytes); });
  header.contentHash = hasher.digest();
  header.headerHash = computeHeaderHash(header, info.options);

  AtomicFile file(path);
  file.write(&header, sizeof(header));
  file.write(info.options);
  forEachBlock(objects, nodes, hierarchy,
               [&](const void* data, std::size_t bytes) { file.write(data, bytes); });
  file.commit();
  info.version = header.version;
  info.contentHash = header.contentHash;
}

Hierarchy readHlodFile(const std::filesystem::path& path, HlodFileInfo* info) {
  HlodFileInfo own;
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  const Header header = readHeader(fd.get(), path, own);
  Hasher hasher;
  startContentHash(hasher, header, own.options);
  std::string objects(header.objectBytes, '\0');
  std::vector<StoredNode> nodes(header.nodes);
  Hierarchy out;
  out.vertices.resize(header.vertices);
  out.indices.resize(header.indices);
  forEachBlock(objects, nodes, out, [&](const void* data, std::size_t bytes) {
    // The blocks are ours and not const; forEachBlock serves writing too.
    char* const block = static_cast<char*>(const_cast<void*>(data));
    for (std::size_t at = 0; at < bytes; at += kFileChunk) {
      const std::size_t size = std::min(kFileChunk, bytes - at);
      readAll(fd.get(), block + at, size, path);
      hasher.add(block + at, size);
    }
  });
  if (hasher.digest() != header.contentHash)
    failOnFile(path, "damaged: the checksum does not match");
  out.objects = unpackObjects(objects, header.objects, path);
  out.nodes.reserve(nodes.size());
  for (const StoredNode& node : nodes) out.nodes.push_back(unpackNode(node));
  out.inputTriangles = header.inputTriangles;
  if (info != nullptr) *info = own;
  return out;
}

HlodFileInfo readHlodFileInfo(const std::filesystem::path& path) {
  HlodFileInfo info;
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  readHeader(fd.get(), path, info);
  return info;
}

}  // namespace hlodbench
