#include "hlod/scene/mesh_reader_ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace hlodbench::mesh_reader {
namespace {

struct TypeName {
  const char* name;
  const char* alias;
  std::uint64_t bytes;
};
constexpr std::array<TypeName, 8> kTypes{{{"char", "int8", 1},
                                          {"uchar", "uint8", 1},
                                          {"short", "int16", 2},
                                          {"ushort", "uint16", 2},
                                          {"int", "int32", 4},
                                          {"uint", "uint32", 4},
                                          {"float", "float32", 4},
                                          {"double", "float64", 8}}};

const TypeName* findType(std::string_view word) {
  const auto it = std::find_if(kTypes.begin(), kTypes.end(), [&](const TypeName& type) {
    return word == type.name || word == type.alias;
  });
  return it == kTypes.end() ? nullptr : &*it;
}

std::string takeType(const FileText& file, const Lines& lines, std::string_view& line) {
  const std::string_view word = takeWord(line);
  const TypeName* type = findType(word);
  if (type == nullptr)
    failAtLine(file, lines.number(), fmt::format("expected a PLY type, found '{}'", word));
  return type->name;
}

PlyProperty takeProperty(const FileText& file, const Lines& lines, std::string_view line) {
  PlyProperty property;
  std::string_view ahead = line;
  if (takeWord(ahead) == "list") {
    line = ahead;
    property.countType = takeType(file, lines, line);
  }
  property.type = takeType(file, lines, line);
  property.name = takeWord(line);
  if (property.name.empty()) failAtLine(file, lines.number(), "expected a property's name");
  return property;
}

PlyElement takeElement(const FileText& file, const Lines& lines, std::string_view line) {
  PlyElement element;
  element.name = takeWord(line);
  const std::string_view word = takeWord(line);
  const auto count = parseNumber<std::uint64_t>(word);
  if (!count || *count > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max()))
    failAtLine(file, lines.number(),
               fmt::format("expected a number of elements from 0 to {}, found '{}'",
                           std::numeric_limits<std::int32_t>::max(), word));
  element.count = *count;
  return element;
}

void takeFormat(const FileText& file, const Lines& lines, std::string_view line,
                PlyHeader& header) {
  header.format = takeWord(line);
  if (header.format != "ascii" && header.format != "binary_little_endian" &&
      header.format != "binary_big_endian")
    failAtLine(file, lines.number(),
               fmt::format("expected the format ascii, binary_little_endian or binary_big_endian, "
                           "found '{}'",
                           header.format));
  header.binary = header.format != "ascii";
}

PlyHeader parseHeader(const FileText& file) {
  Lines lines(file.bytes);
  std::string_view line;
  lines.next(line);
  if (takeWord(line) != "ply") fail(file, "expected a PLY file, which begins with 'ply'");
  PlyHeader header;
  while (lines.next(line)) {
    const std::string_view keyword = takeWord(line);
    if (keyword == "end_header") {
      if (header.format.empty()) failAtLine(file, lines.number(), "the header names no format");
      header.bodyBegin = static_cast<std::size_t>(line.data() - file.bytes.data());
      header.bodyBegin = std::min(file.bytes.find('\n', header.bodyBegin), file.bytes.size() - 1);
      ++header.bodyBegin;
      return header;
    }
    if (keyword == "format") {
      takeFormat(file, lines, line, header);
    } else if (keyword == "element") {
      header.elements.push_back(takeElement(file, lines, line));
    } else if (keyword == "property") {
      if (header.elements.empty())
        failAtLine(file, lines.number(), "expected an element before the first property");
      header.elements.back().properties.push_back(takeProperty(file, lines, line));
    } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
      failAtLine(file, lines.number(),
                 fmt::format("'{}' is no keyword of a PLY header", keyword.substr(0, 40)));
    }
  }
  fail(file, "truncated: the header has no end_header");
}

// The fewest bytes one record of this element can take.
std::uint64_t smallestRecord(const PlyElement& element, bool binary) {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    const std::string& type = property.countType.empty() ? property.type : property.countType;
    bytes += binary ? findType(type)->bytes : 2;  // a digit and a space
  }
  return bytes;
}

void checkSize(const FileText& file, std::uint64_t fileBytes, const PlyHeader& header) {
  const std::uint64_t left = fileBytes - header.bodyBegin + 1;  // last space may be missing
  std::uint64_t needed = 0;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty() && element.count > 0)
      fail(file, fmt::format("element {} has no property", element.name));
    needed += element.count * smallestRecord(element, header.binary);
  }
  if (needed > left)
    fail(file, fmt::format("truncated: the header promises at least {} bytes of data, found {}",
                           needed, left - 1));
}

void checkVertexRecord(const FileText& file, const PlyHeader& header, const PlyElement& vertex) {
  for (const char* axis : {"x", "y", "z"}) {
    const auto has = std::count_if(vertex.properties.begin(), vertex.properties.end(),
                                   [&](const PlyProperty& p) { return p.name == axis; });
    if (has != 1) fail(file, fmt::format("expected one vertex property {}, found {}", axis, has));
  }
  for (const PlyProperty& property : vertex.properties) {
    const bool axis = property.name == "x" || property.name == "y" || property.name == "z";
    if (axis && header.binary && property.type != "float" && property.type != "double")
      fail(file, fmt::format("vertex property {}: expected type float or double, found {}",
                             property.name, property.type));
  }
}

bool isCornerList(const PlyProperty& property) {
  return !property.countType.empty() &&
         (property.name == "vertex_indices" || property.name == "vertex_index");
}

void checkFaceRecord(const FileText& file, const PlyHeader& header, const PlyElement& face) {
  if (face.properties.empty() || !isCornerList(face.properties.front()))
    fail(file, "expected the list vertex_indices as the first property of face");
  const PlyProperty& corners = face.properties.front();
  if (corners.type == "float" || corners.type == "double")
    fail(file, fmt::format("expected vertex_indices of an integer type, found {}", corners.type));
  const std::string& count = corners.countType;
  if (header.binary &&
      (count == "short" || count == "ushort" || count == "float" || count == "double"))
    fail(file,
         fmt::format("vertex_indices: expected a length of type uchar or int, found {}", count));
}

// OpenMesh takes a list other than the faces' corners for a single number.
void checkLists(const FileText& file, const PlyElement& element) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    const bool corners = element.name == "face" && i == 0;
    if (!property.countType.empty() && !corners)
      fail(file, fmt::format("{} property {}: lists other than vertex_indices are not read; save "
                             "the mesh without it",
                             element.name, property.name));
  }
}

}  // namespace

PlyHeader readPlyHeader(const FileText& file, std::uint64_t fileBytes) {
  PlyHeader header = parseHeader(file);
  int toFind = 2;
  std::size_t used = 0;
  for (std::size_t i = 0; i < header.elements.size(); ++i) {
    const PlyElement& element = header.elements[i];
    if (element.name != "vertex" && element.name != "face") continue;
    if (--toFind < 0) fail(file, fmt::format("element {} is there twice", element.name));
    (element.name == "vertex" ? header.vertices : header.faces) = element.count;
    element.name == "vertex" ? checkVertexRecord(file, header, element)
                             : checkFaceRecord(file, header, element);
    used = i + 1;
  }
  if (toFind != 0) fail(file, "expected the elements vertex and face, each once");
  header.moreElements = used < header.elements.size();
  header.elements.resize(used);
  for (const PlyElement& element : header.elements) checkLists(file, element);
  checkSize(file, fileBytes, header);
  return header;
}

std::uint64_t sizeOfPlyType(const std::string& type) {
  return findType(type)->bytes;
}

std::string writePlainHeader(const PlyHeader& header) {
  std::string text = fmt::format("ply\nformat {} 1.0\n", header.format);
  int skipped = 0;
  for (const PlyElement& element : header.elements) {
    text += fmt::format("element {} {}\n", element.name, element.count);
    for (const PlyProperty& property : element.properties) {
      if (!property.countType.empty()) {
        // OpenMesh knows these two lengths only; of the same width, they read the same numbers.
        const bool oneByte = findType(property.countType)->bytes == 1;
        text += fmt::format("property list {} {} vertex_indices\n", oneByte ? "uchar" : "int",
                            property.type);
        continue;
      }
      const bool axis = element.name == "vertex" && property.name.size() == 1 &&
                        property.name >= "x" && property.name <= "z";
      text += fmt::format("property {} {}\n", property.type,
                          axis ? property.name : fmt::format("skipped{}", skipped++));
    }
  }
  return text + "end_header\n";
}

}  // namespace hlodbench::mesh_reader
