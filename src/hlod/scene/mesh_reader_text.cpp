// OBJ and OFF, line by line. OpenMesh reads these too, but it leaves out an OBJ vertex it does not
// understand, which shifts every index after it, leaves out faces that name a vertex twice, opens
// whatever file an OBJ's mtllib names, and takes a comment in an OFF file for numbers.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "hlod/scene/mesh_reader_parts.h"

namespace hlodbench::mesh_reader {
namespace {

// Statements of the OBJ format that hold no vertex and no face, and "vc", a usual extension.
constexpr std::array<std::string_view, 45> kObjIgnored{
    "vt",   "vn",    "vp",       "vc",       "g",       "o",      "s",          "l",
    "p",    "mg",    "usemtl",   "mtllib",   "usemap",  "maplib", "shadow_obj", "trace_obj",
    "lod",  "bevel", "c_interp", "d_interp", "cstype",  "deg",    "bmat",       "step",
    "curv", "curv2", "surf",     "parm",     "trim",    "hole",   "scrv",       "sp",
    "end",  "con",   "call",     "csh",      "ctech",   "stech",  "bsp",        "bzp",
    "cdc",  "cdp",   "res",      "fo",       "call_obj"};

// An OBJ may use a vertex before it is there, so ranges are checked at the end.
struct ObjFaces {
  std::uint32_t largest = 0;        // vertex, from 0
  std::uint64_t largestAtLine = 0;  // where it is named; 0: no face yet
  std::vector<std::uint32_t> corners;
};

void readObjFace(const FileText& file, const Lines& lines, std::string_view line, ObjFaces& faces,
                 MeshFile& mesh) {
  const auto known = static_cast<std::int64_t>(mesh.positions.size());
  faces.corners.clear();
  for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
    if (word.starts_with('#')) break;
    const auto index = parseNumber<std::int64_t>(word.substr(0, word.find('/')));
    if (!index || *index == 0 || *index < -known ||
        *index > std::numeric_limits<std::uint32_t>::max())
      failAtLine(
          file, lines.number(),
          fmt::format("expected a vertex from 1, or from -{} to -1, found '{}'", known, word));
    const std::int64_t fromZero = *index > 0 ? *index - 1 : known + *index;
    faces.corners.push_back(static_cast<std::uint32_t>(fromZero));
    if (faces.largestAtLine == 0 || faces.corners.back() > faces.largest) {
      faces.largest = faces.corners.back();
      faces.largestAtLine = lines.number();
    }
  }
  if (faces.corners.size() < 3)
    failAtLine(file, lines.number(),
               fmt::format("expected a face of 3 corners or more, found {}", faces.corners.size()));
  addPolygon(faces.corners, mesh);
}

// A backslash at the end of a line continues it on the next.
std::string joinContinuedLines(std::string text) {
  for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
    const std::size_t end = at + 1 + (text.compare(at + 1, 1, "\r") == 0 ? 1 : 0);
    if (end < text.size() && text[end] == '\n') text.replace(at, end - at + 1, end - at + 1, ' ');
  }
  return text;
}

// The next line that is neither blank nor a comment, without the comment at its end.
bool nextOffLine(Lines& lines, std::string_view& line) {
  while (lines.next(line)) {
    line = line.substr(0, line.find('#'));
    std::string_view ahead = line;
    if (!takeWord(ahead).empty()) return true;
  }
  return false;
}

struct OffCounts {
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
};

OffCounts readOffCounts(const FileText& file, Lines& lines) {
  std::string_view line;
  if (!nextOffLine(lines, line)) fail(file, "expected an OFF file, found nothing but comments");
  std::string_view ahead = line;
  std::string_view keyword = takeWord(ahead);
  const std::size_t letters = std::min(keyword.find_first_of("0123456789"), keyword.size());
  const std::string_view kind = keyword.substr(0, letters);
  if (kind == "OFF" || kind == "COFF" || kind == "NOFF" || kind == "CNOFF" || kind == "STOFF" ||
      kind == "STCOFF" || kind == "STNOFF" || kind == "STCNOFF") {
    line.remove_prefix(static_cast<std::size_t>(keyword.data() - line.data()) + letters);
  } else if (!kind.empty()) {
    failAtLine(file, lines.number(),
               fmt::format("expected the keyword OFF, found '{}'", keyword.substr(0, 40)));
  }
  ahead = line;
  if (takeWord(ahead) == "BINARY") failAtLine(file, lines.number(), "binary OFF is not read");
  ahead = line;
  if (takeWord(ahead).empty() && !nextOffLine(lines, line))
    fail(file, "truncated: the numbers of vertices and faces are missing");
  OffCounts counts;
  for (std::uint64_t* count : {&counts.vertices, &counts.faces}) {
    const std::string_view word = takeWord(line);
    const auto value = parseNumber<std::uint64_t>(word);
    // Each vertex and each face takes a line of its own, so more than the bytes cannot be.
    if (!value || *value > file.bytes.size())
      failAtLine(file, lines.number(),
                 fmt::format("expected the numbers of vertices and faces, found '{}'", word));
    *count = *value;
  }
  return counts;
}

void readOffFace(const FileText& file, const Lines& lines, std::string_view line,
                 std::vector<std::uint32_t>& corners, MeshFile& mesh) {
  const std::string_view first = takeWord(line);
  const auto count = parseNumber<std::uint64_t>(first);
  if (!count || *count < 3 || *count > file.bytes.size())
    failAtLine(file, lines.number(),
               fmt::format("expected a face of 3 corners or more, found '{}'", first));
  corners.clear();
  for (std::uint64_t i = 0; i < *count; ++i) {
    const std::string_view word = takeWord(line);
    const auto index = parseNumber<std::uint64_t>(word);
    if (!index || *index >= mesh.positions.size())
      failAtLine(file, lines.number(),
                 fmt::format("expected a vertex from 0 to {}, found '{}'",
                             static_cast<std::int64_t>(mesh.positions.size()) - 1, word));
    corners.push_back(static_cast<std::uint32_t>(*index));
  }
  addPolygon(corners, mesh);
}

}  // namespace

MeshFile readObj(const FileText& file) {
  const std::string text = joinContinuedLines(file.bytes);
  Lines lines(text);
  MeshFile mesh;
  ObjFaces faces;
  for (std::string_view line; lines.next(line);) {
    const std::string_view keyword = takeWord(line);
    if (keyword == "v") {
      mesh.positions.push_back(takePoint(file, lines, line));
    } else if (keyword == "f") {
      readObjFace(file, lines, line, faces, mesh);
    } else if (!keyword.empty() && !keyword.starts_with('#') &&
               std::find(kObjIgnored.begin(), kObjIgnored.end(), keyword) == kObjIgnored.end()) {
      failAtLine(file, lines.number(),
                 fmt::format("'{}' is no statement of an OBJ file", keyword.substr(0, 40)));
    }
  }
  if (faces.largestAtLine > 0 && faces.largest >= mesh.positions.size())
    failAtLine(file, faces.largestAtLine,
               fmt::format("expected a vertex from 1 to {}, found {}", mesh.positions.size(),
                           std::uint64_t{faces.largest} + 1));
  return mesh;
}

MeshFile readOff(const FileText& file) {
  Lines lines(file.bytes);
  const OffCounts counts = readOffCounts(file, lines);
  MeshFile mesh;
  std::string_view line;
  for (std::uint64_t i = 0; i < counts.vertices; ++i) {
    if (!nextOffLine(lines, line))
      fail(file, fmt::format("truncated: expected {} vertices, found {}", counts.vertices, i));
    mesh.positions.push_back(takePoint(file, lines, line));
  }
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < counts.faces; ++i) {
    if (!nextOffLine(lines, line))
      fail(file, fmt::format("truncated: expected {} faces, found {}", counts.faces, i));
    readOffFace(file, lines, line, corners, mesh);
  }
  if (nextOffLine(lines, line))
    failAtLine(file, lines.number(),
               fmt::format("expected the end after {} vertices and {} faces", counts.vertices,
                           counts.faces));
  return mesh;
}

}  // namespace hlodbench::mesh_reader
