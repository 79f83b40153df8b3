#include <random>

#include "mesh_samples.h"

namespace hlodbench {
namespace {

using ::testing::HasSubstr;

// Sizes to cut a file to: every one of the last 60, some before.
std::vector<std::size_t> chooseCuts(std::size_t end) {
  std::vector<std::size_t> cuts;
  for (std::size_t size = 0; size < end; size += size + 60 < end ? 11 : 1) cuts.push_back(size);
  return cuts;
}

}  // namespace

TEST_F(MeshReader, RefusesPlyCutAnywhere) {
  for (const Flavour& flavour : plyFlavours()) {
    // The last number of a text may lose its last digits or the space behind it unnoticed.
    const std::size_t lastNumber = flavour.file == "a.ply" ? 3 : 0;
    for (const std::size_t size : chooseCuts(flavour.bytes.size() - lastNumber)) {
      SCOPED_TRACE(flavour.file + " cut to " + std::to_string(size));
      readError(flavour.file, flavour.bytes.substr(0, size));
    }
  }
}

TEST_F(MeshReader, RefusesOffAndStlCutAnywhere) {
  const auto refuses = [&](const std::string& file, const std::string& bytes, std::size_t end) {
    for (const std::size_t size : chooseCuts(end)) {
      SCOPED_TRACE(file + " cut to " + std::to_string(size));
      readError(file, bytes.substr(0, size));
    }
  };
  refuses("a.off", offText(), offText().rfind("4 255"));
  refuses("a.stl", asciiStl(), asciiStl().rfind("endsolid") + 8);
  refuses("b.stl", binaryStl(), binaryStl().size());
}

TEST_F(MeshReader, RefusesAnyFileCutInsideItsGzip) {
  for (const Flavour& flavour : allFlavours()) {
    const fs::path whole = writeGzipped("whole.gz", flavour.bytes);
    std::ifstream in(whole, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    for (const std::size_t size : chooseCuts(bytes.size()))
      readError(flavour.file + ".gz", bytes.substr(0, size));
  }
}

TEST_F(MeshReader, RefusesDataBehindTheEnd) {
  for (const Flavour& flavour : plyFlavours())
    EXPECT_THAT(readError(flavour.file, flavour.bytes + "7"), HasSubstr("more bytes"));
  EXPECT_THAT(readError("a.off", offText() + "3 0 1 2\n"), HasSubstr("expected the end"));
  readError("b.stl", binaryStl() + "7");
}

TEST_F(MeshReader, NamesThePlaceOfEachFaultInAPly) {
  const auto change = [](const std::string& from, const std::string& to) {
    std::string text = asciiPly();
    text.replace(text.rfind(from), from.size(), to);
    return text;
  };
  const std::vector<std::array<std::string, 3>> cases{
      {"\n3 1 2 4", "\n3 1 2 5", "face 2 (from 0): expected vertices 0 to 4, found vertex 5"},
      {"\n3 1 2 4", "\n3 1 -2 4", "face 2 (from 0): expected vertices 0 to 4"},
      {"\n3 1 2 4", "\n2 1 2", "face 2 (from 0): expected 3 corners or more, found 2"},
      {"\n3 1 2 4", "\n4000000000 1 2 4", "the file ends in face 2 (from 0) of 7"},
      {"\n3 1 2 4", "\n3 1 x 4", "face 2 (from 0) of 7: expected a number"},
      {"0.5 0.25", "nan 0.25", "vertex 4 (from 0) of 5: expected a number"},
      {"0.5 0.25", "1e99 0.25", "vertex 4 (from 0)"},
      {"vertex 5\n", "vertex 4000000000\n", "line 5: expected a number of elements from 0 to"},
      {"vertex 5\n", "vertex 2000000000\n", "truncated: the header promises at least"},
      {"vertex 5\n", "vertex -5\n", "line 5: expected a number of elements"},
      {"float z", "float w", "expected one vertex property z, found 0"},
      {"float z", "real z", "line 8: expected a PLY type, found 'real'"},
      {"element face", "element faces", "expected the elements vertex and face"},
      {"list uchar", "list uchar uchar a\nproperty list uchar", "expected the list vertex_indices"},
      {"short quality", "list uchar float uv", "face property uv: lists other than"},
      {"ascii", "ascii_2", "line 2: expected the format ascii"},
      {"property uchar", "proprety uchar", "line 9: 'proprety' is no keyword"},
      {"end_header\n0", "0", "is no keyword of a PLY header"},
      {"ply\nformat", "plx\nformat", "begins with 'ply'"}};
  for (const auto& [from, to, message] : cases)
    EXPECT_THAT(readError("bad.ply", change(from, to)), HasSubstr(message)) << from;
  EXPECT_THAT(readError("bad.ply", "ply\nformat ascii 1.0\n"), HasSubstr("no end_header"));
}

TEST_F(MeshReader, RefusesBinaryPlyThatOpenMeshWouldMisread) {
  std::string bytes = binaryPly<float, std::uint8_t>(false, "float", "ushort");
  EXPECT_THAT(readError("a.ply", bytes), HasSubstr("expected a length of type uchar or int"));
  bytes = binaryPly<float, std::uint8_t>(false, "int", "uchar");
  EXPECT_THAT(readError("a.ply", bytes), HasSubstr("expected type float or double, found int"));
}

TEST_F(MeshReader, RefusesBinaryVerticesThatAreNotFinite) {
  std::string bytes = binaryPly<float, std::uint8_t>(true, "float", "uchar");
  const std::size_t body = bytes.find("\nend_header\n") + 12;
  bytes.replace(body + 2 * 13, 4, "\x7f\x80\0\0", 4);
  EXPECT_THAT(readError("a.ply", bytes), HasSubstr("vertex 2 (from 0): expected finite"));
  bytes = binaryStl();
  bytes.replace(84 + 12 + 12, 4, "\0\0\xc0\x7f", 4);
  EXPECT_THAT(readError("b.stl", bytes), HasSubstr("vertex 1 (from 0): expected finite"));
}

TEST_F(MeshReader, NamesTheLineOfEachFaultInATextFile) {
  const std::vector<std::array<std::string, 3>> cases{
      {"a.obj", "v 0 0 0\nv 1 x 0\n", "line 2: expected 3 coordinates, found 'x'"},
      {"a.obj", "v 0 0 0\nv 1 0\n", "line 2: expected 3 coordinates, found ''"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4: expected a vertex from 1 to 3"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "line 4: expected a vertex from 1"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "line 4: expected a vertex from 1"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "line 3: expected a face of 3 corners or more"},
      {"a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "vertex 1 (from 0): expected finite"},
      {"a.obj", "v 0 0 0\nv 1e50 0 0\nv 0 1 0\nf 1 2 3\n", "vertex 1 (from 0): expected finite"},
      {"a.obj", "v 0 0 0\nhello\n", "line 2: 'hello' is no statement"},
      {"a.obj", "v 0 0 0\n", "expected at least one face, found none"},
      {"a.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", "none of the 1 triangles has any area"},
      {"a.off", "PLY\n", "line 1: expected the keyword OFF, found 'PLY'"},
      {"a.off", "OFF BINARY\n", "line 1: binary OFF is not read"},
      {"a.off", "OFF\n3 x 0\n", "line 2: expected the numbers of vertices and faces"},
      {"a.off", "OFF\n4000000000 4 0\n", "line 2: expected the numbers of vertices and faces"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: expected a vertex from 0"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "line 6: expected a face of 3"},
      {"a.stl", "solid a\nvertex 0 0 0\n", "line 2: 'vertex' is not expected here"},
      {"a.stl", "solid a\nfacet\nouter\nvertex 0 0 0\nendloop", "line 5: expected 3 corners"},
      {"a.stl", "something else", "truncated: expected at least 84 bytes, found 14"}};
  for (const auto& [file, text, message] : cases)
    EXPECT_THAT(readError(file, text), HasSubstr(message)) << text;
}

TEST_F(MeshReader, NamesTheKnownFormats) {
  EXPECT_THAT(readError("a.fbx", "x"), HasSubstr("'.fbx'; known are .ply .obj .off .stl"));
  EXPECT_THAT(readError("a.gz", "x"), HasSubstr("known are"));
  EXPECT_THAT(errorOf(folder_ / "none.ply"), HasSubstr("no such file"));
  fs::create_directory(folder_ / "folder.ply");
  EXPECT_THAT(errorOf(folder_ / "folder.ply"), HasSubstr("expected a file"));
  EXPECT_THAT(readError("empty.stl", ""), HasSubstr("the file is empty"));
  EXPECT_THAT(readError("plain.ply.gz", asciiPly()), HasSubstr("expected gzip data"));
}

TEST_F(MeshReader, ReadsOrRefusesButNeverBreaksOnChangedBytes) {
  std::mt19937 random(7);
  for (const Flavour& flavour : allFlavours()) {
    for (int round = 0; round < 120; ++round) {
      std::string bytes = flavour.bytes;
      for (int change = 0; change < 1 + round % 3; ++change)
        bytes[random() % bytes.size()] = static_cast<char>(random());
      try {
        const MeshFile mesh = readMeshFile(write(flavour.file, bytes));
        for (const glm::uvec3& t : mesh.triangles)
          for (int i = 0; i < 3; ++i) ASSERT_LT(t[i], mesh.positions.size());
        for (const glm::vec3& p : mesh.positions) ASSERT_FALSE(glm::any(glm::isinf(p)));
      } catch (const InputError& error) {
        for (const char c : std::string(error.what())) ASSERT_TRUE(c >= ' ' && c < 127);
      }
    }
  }
}

}  // namespace hlodbench
