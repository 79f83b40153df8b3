#include "hlod/scene/mesh_reader.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <system_error>

#include "hlod/core/error.h"
#include "hlod/scene/mesh_reader_faults.h"
#include "hlod/scene/mesh_reader_parts.h"

namespace hlodbench {
namespace mesh_reader {

void fail(const FileText& file, const std::string& what) {
  // What stands in a corrupt file must not reach the terminal as control characters.
  std::string shown = what;
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  throw InputError(fmt::format("{}: {}", file.name, shown));
}

void failAtLine(const FileText& file, std::uint64_t line, const std::string& what) {
  fail(file, fmt::format("line {}: {}", line, what));
}

void addPolygon(std::span<const std::uint32_t> corners, MeshFile& mesh) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
  if (corners.size() > 3) ++mesh.polygonsSplit;
}

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return text;
}

bool Lines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++number_;
  return true;
}

std::string_view takeWord(std::string_view& line) {
  constexpr std::string_view kSpace = " \t\r\f\v";
  const std::size_t begin = line.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) {
    line = {};
    return {};
  }
  const std::size_t end = std::min(line.find_first_of(kSpace, begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

glm::vec3 takePoint(const FileText& file, const Lines& lines, std::string_view& line) {
  glm::dvec3 point;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string_view word = takeWord(line);
    const auto value = parseNumber<double>(word);
    if (!value)
      failAtLine(file, lines.number(), fmt::format("expected 3 coordinates, found '{}'", word));
    point[axis] = *value;
  }
  return glm::vec3(point);
}

namespace {

constexpr const char* kKnownEndings = ".ply .obj .off .stl, each also with .gz";

std::string readPlainFile(const std::string& name) {
  std::ifstream in(name, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot be opened for reading", name));
  std::string bytes(std::filesystem::file_size(name), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw InputError(fmt::format("{}: cannot be read to its end", name));
  return bytes;
}

std::string readGzippedFile(const std::string& name) {
  constexpr unsigned kChunk = 1u << 20;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(name.c_str(), "rb"), gzclose);
  if (!in) throw InputError(fmt::format("{}: cannot be opened for reading", name));
  gzbuffer(in.get(), kChunk);
  std::string bytes;
  std::size_t used = 0;
  for (;;) {
    bytes.resize(std::max<std::size_t>(bytes.size(), used + kChunk));
    const int got = gzread(in.get(), bytes.data() + used, kChunk);
    // A file that ends early shows as an error state after a short read, not as -1.
    int state = Z_OK;
    const char* message = gzerror(in.get(), &state);
    if (got < 0 || (state != Z_OK && state != Z_STREAM_END))
      throw InputError(fmt::format("{}: truncated or corrupt gzip data: {}", name, message));
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
    if (used + kChunk > bytes.size()) bytes.resize(bytes.size() * 2);
  }
  // zlib hands out what does not begin like gzip as it is; such a file is not what it says.
  if (gzdirect(in.get()) != 0)
    throw InputError(fmt::format("{}: expected gzip data, found something else", name));
  bytes.resize(used);
  return bytes;
}

FileText readBytes(const std::filesystem::path& path, bool gzipped) {
  const std::string name = path.string();
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(fmt::format("{}: no such file", name));
  if (!std::filesystem::is_regular_file(status))
    throw InputError(fmt::format("{}: expected a file, found a folder or a device", name));
  FileText file{name, {}};
  if (std::filesystem::file_size(path) == 0) fail(file, "the file is empty");
  file.bytes = gzipped ? readGzippedFile(name) : readPlainFile(name);
  if (file.bytes.empty()) fail(file, "the file is empty");
  return file;
}

void checkMesh(const FileText& file, const MeshFile& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (!isFinite(mesh.positions[i])) failOnPosition(file, i, mesh.positions[i]);
  if (mesh.triangles.empty()) fail(file, "expected at least one face, found none");
  for (const glm::uvec3& t : mesh.triangles)
    if (hasArea(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z])) return;
  failOnArea(file, mesh.triangles.size());
}

}  // namespace
}  // namespace mesh_reader

MeshFile readMeshFile(const std::filesystem::path& path) {
  namespace reader = mesh_reader;
  std::string ending = reader::lowerCase(path.extension().string());
  const bool gzipped = ending == ".gz";
  if (gzipped) ending = reader::lowerCase(path.stem().extension().string());
  if (ending != ".ply" && ending != ".obj" && ending != ".off" && ending != ".stl")
    throw InputError(fmt::format("{}: unknown mesh format '{}{}'; known are {}", path.string(),
                                 ending, gzipped ? ".gz" : "", reader::kKnownEndings));
  reader::FileText file = reader::readBytes(path, gzipped);
  const reader::FileText named{file.name, {}};
  MeshFile mesh = ending == ".ply"   ? reader::readPly(std::move(file))
                  : ending == ".obj" ? reader::readObj(file)
                  : ending == ".off" ? reader::readOff(file)
                                     : reader::readStl(file);
  reader::checkMesh(named, mesh);
  return mesh;
}

}  // namespace hlodbench
