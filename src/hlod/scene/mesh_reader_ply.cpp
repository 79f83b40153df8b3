// PLY through OpenMesh's reader, made strict. OpenMesh 9 reads on past the end of a file, hangs on
// a header without an end and misreads records that hold lists of other things. So the header is
// read here first and OpenMesh gets a plain one that says the same; the stream throws where the
// file ends early; and what has been read is compared with what the header promised.

#include <fmt/format.h>

#include <OpenMesh/Core/IO/IOManager.hh>
#include <limits>
#include <locale>
#include <mutex>
#include <sstream>

#include "hlod/scene/mesh_reader_parts.h"
#include "hlod/scene/mesh_reader_ply_header.h"
#include "hlod/scene/mesh_reader_soup.h"

namespace hlodbench::mesh_reader {
namespace {

// Keeps OpenMesh's messages off the terminal; ours is the one line the user gets.
class QuietOpenMesh {
 public:
  QuietOpenMesh() : errors_(omerr().is_enabled()), log_(omlog().is_enabled()) {
    omerr().disable();
    omlog().disable();
  }
  ~QuietOpenMesh() {
    if (errors_) omerr().enable();
    if (log_) omlog().enable();
  }
  QuietOpenMesh(const QuietOpenMesh&) = delete;
  QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;

 private:
  bool errors_;
  bool log_;
};

std::string describeStop(const PlyHeader& header, const SoupImporter& soup, bool atEnd) {
  const std::size_t vertices = soup.pointsSet();
  const std::string place =
      vertices < header.vertices
          ? fmt::format("vertex {} (from 0) of {}", vertices, header.vertices)
          : fmt::format("face {} (from 0) of {}", soup.n_faces(), header.faces);
  return atEnd ? fmt::format("truncated: the file ends in {}", place)
               : fmt::format("{}: expected a number, found something else", place);
}

}  // namespace

MeshFile readPly(FileText file) {
  // OpenMesh's readers are global objects with a state of their own.
  static std::mutex oneAtATime;
  const std::lock_guard lock(oneAtATime);
  const QuietOpenMesh quiet;

  const PlyHeader header = readPlyHeader(file, file.bytes.size());
  const std::string plain = writePlainHeader(header);
  file.bytes.replace(0, header.bodyBegin, plain);
  const std::size_t size = file.bytes.size();

  std::istringstream in(std::move(file.bytes), std::ios::in | std::ios::binary);
  in.imbue(std::locale::classic());
  in.exceptions(std::ios::failbit | std::ios::badbit);
  SoupImporter soup(file.name, header.vertices);
  OpenMesh::IO::Options options;
  bool understood = false;
  try {
    understood = OpenMesh::IO::IOManager().read(in, "ply", soup, options);
  } catch (const std::ios_base::failure&) {
    fail(file, describeStop(header, soup, in.eof()));
  }
  if (!understood || soup.pointsSet() != header.vertices || soup.n_faces() != header.faces)
    fail(file, fmt::format("expected {} vertices and {} faces, found {} and {}", header.vertices,
                           header.faces, soup.pointsSet(), soup.n_faces()));
  if (!header.moreElements && !in.eof()) {
    in.exceptions(std::ios::goodbit);
    if (!header.binary) in >> std::ws;
    if (in.good() && in.peek() != std::istringstream::traits_type::eof())
      failOnMore(file, header.vertices, header.faces, size - static_cast<std::size_t>(in.tellg()));
  }
  return soup.takeMesh();
}

}  // namespace hlodbench::mesh_reader
