#pragma once

// The header of a PLY file; nobody but the readers of PLY includes this.

#include <cstdint>
#include <string>
#include <vector>

#include "hlod/scene/mesh_reader_parts.h"

namespace hlodbench::mesh_reader {

struct PlyProperty {
  std::string name;
  std::string type;       // one of char uchar short ushort int uint float double
  std::string countType;  // of a list: the type of its length; empty: not a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  std::string format;  // as in the file, e.g. binary_little_endian
  bool binary = false;
  std::vector<PlyElement> elements;  // up to the later of vertex and face
  bool moreElements = false;         // others follow, which nobody reads
  std::uint64_t vertices = 0;
  std::uint64_t faces = 0;
  std::size_t bodyBegin = 0;  // bytes, from the file's begin
};

// file: its bytes, at least the header's; fileBytes: how many there are in all.
// Throws InputError for a header that is cut, not understood, or promises more than the file's
// bytes can hold, and for records that OpenMesh's reader would misread.
PlyHeader readPlyHeader(const FileText& file, std::uint64_t fileBytes);

// Bytes of a number of one of PlyProperty's types.
std::uint64_t sizeOfPlyType(const std::string& type);

// A header of the same records without comments, in which every property that is not a coordinate
// or the faces' corner list has a name that means nothing.
std::string writePlainHeader(const PlyHeader& header);

}  // namespace hlodbench::mesh_reader
