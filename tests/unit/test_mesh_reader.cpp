#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "hlod/core/error.h"
#include "hlod/scene/mesh_reader.h"

namespace hlodbench {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class MeshReader : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("hlodbench_mesh_") + info->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  fs::path writeGzipped(const std::string& name, const std::string& bytes) const {
    const gzFile out = gzopen((folder_ / name).c_str(), "wb");
    EXPECT_EQ(gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size())),
              static_cast<int>(bytes.size()));
    gzclose(out);
    return folder_ / name;
  }
  // The message of the InputError that reading must throw; one line that begins with the file.
  std::string readError(const std::string& name, const std::string& bytes) const {
    return errorOf(write(name, bytes));
  }
  static std::string errorOf(const fs::path& path) {
    try {
      readMeshFile(path);
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      EXPECT_EQ(what.rfind(path.string() + ": ", 0), 0u) << what;
      return what;
    }
    ADD_FAILURE() << path << " was read";
    return "";
  }

  fs::path folder_;
};

// A pyramid with a square base: 5 vertices, one quad and four triangles, and one repeated and one
// degenerate face, which a half-edge mesh would refuse.
const std::vector<glm::vec3> kPoints{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.25f, 2}};
const std::vector<std::vector<int>> kFaces{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4},
                                           {3, 0, 4},    {0, 1, 4}, {1, 1, 4}};
const std::vector<glm::uvec3> kTriangles{{0, 3, 2}, {0, 2, 1}, {0, 1, 4}, {1, 2, 4},
                                         {2, 3, 4}, {3, 0, 4}, {0, 1, 4}, {1, 1, 4}};

std::string coordinates(const glm::vec3& p) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << p.x << ' ' << p.y << ' ' << p.z;
  return text.str();
}

template <typename T>
void append(std::string& bytes, T value, bool bigEndian) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (bigEndian == (std::endian::native == std::endian::little)) std::ranges::reverse(raw);
  bytes.append(raw.data(), raw.size());
}

std::string plyHeader(const std::string& format, const std::string& real = "float",
                      const std::string& faceList = "list uchar int vertex_indices") {
  return "ply\nformat " + format + " 1.0\ncomment element vertex 7 end_header\n" +
         "obj_info element face 3\nelement vertex 5\nproperty " + real + " x\nproperty " + real +
         " y\nproperty " + real + " z\nproperty uchar red\nelement face 7\nproperty " + faceList +
         "\nproperty short quality\nend_header\n";
}

std::string asciiPly() {
  std::string text = plyHeader("ascii");
  for (const glm::vec3& p : kPoints) text += coordinates(p) + " 200\n";
  for (const auto& face : kFaces) {
    text += std::to_string(face.size());
    for (const int corner : face) (text += ' ') += std::to_string(corner);
    text += " -5\n";
  }
  return text;
}

template <typename Real, typename Count>
std::string binaryPly(bool bigEndian, const std::string& real, const std::string& count) {
  std::string bytes = plyHeader(bigEndian ? "binary_big_endian" : "binary_little_endian", real,
                                "list " + count + " uint32 vertex_index");
  for (const glm::vec3& p : kPoints) {
    for (int i = 0; i < 3; ++i) append(bytes, static_cast<Real>(p[i]), bigEndian);
    append(bytes, std::uint8_t{200}, bigEndian);
  }
  for (const auto& face : kFaces) {
    append(bytes, static_cast<Count>(face.size()), bigEndian);
    for (const int corner : face) append(bytes, static_cast<std::uint32_t>(corner), bigEndian);
    append(bytes, std::int16_t{-5}, bigEndian);
  }
  return bytes;
}

std::string objText() {
  std::string text = "# pyramid\nmtllib no_such_file.mtl\no body\n";
  for (std::size_t i = 0; i < kPoints.size(); ++i)
    text += "v " + coordinates(kPoints[i]) + (i == 2 ? " 0.5 0.5 0.5\r\n" : "\n");
  text += "vn 0 0 1\nvt 0 0\nusemtl brick\ns off\n";
  text += "f 1 4 \\\n3 2\n";        // continued
  text += "f 1/1/1 2/1/1 5/1/1\n";  // all three
  text += "f -4//1 -3//1 -1//1\nf 3/1 4/1 5/1 # note\n\tf 4 1 5\nf 1 2 5\nf 2 2 5\n";
  return text;
}

std::string offText() {
  std::string text = "OFF # comment\n# another\n\n5 7 0\n";
  for (const glm::vec3& p : kPoints) text += coordinates(p) + " # vertex\n";
  for (const auto& face : kFaces) {
    text += std::to_string(face.size());
    for (const int corner : face) (text += "  ") += std::to_string(corner);
    text += " 255 0 0\n\n";
  }
  return text;
}

std::string asciiStl() {
  std::string text = "solid pyramid\n";
  for (const glm::uvec3& t : kTriangles) {
    text += "  facet normal nan 0 0\n    outer loop\n";
    for (int i = 0; i < 3; ++i) text += "      vertex " + coordinates(kPoints[t[i]]) + "\n";
    text += "    ENDLOOP\n  endfacet\n";
  }
  return text + "endsolid pyramid\n";
}

std::string binaryStl() {
  std::string bytes = "solid is what many exporters begin with";
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(kTriangles.size()), false);
  for (const glm::uvec3& t : kTriangles) {
    for (int i = 0; i < 3; ++i) append(bytes, 0.0f, false);
    for (int i = 0; i < 9; ++i) append(bytes, kPoints[t[i / 3]][i % 3], false);
    append(bytes, std::uint16_t{0}, false);
  }
  return bytes;
}

// The corner positions, triangle by triangle: the same for indexed files and for STL.
std::vector<glm::vec3> unroll(const std::vector<glm::vec3>& points,
                              const std::vector<glm::uvec3>& triangles) {
  std::vector<glm::vec3> corners;
  for (const glm::uvec3& t : triangles)
    for (int i = 0; i < 3; ++i) corners.push_back(points.at(t[i]));
  return corners;
}

struct Flavour {
  std::string file;
  std::string bytes;
};
std::vector<Flavour> plyFlavours() {
  return {{"a.ply", asciiPly()},
          {"le.ply", binaryPly<float, std::uint8_t>(false, "float", "uchar")},
          {"be.ply", binaryPly<float, std::uint8_t>(true, "float32", "uint8")},
          {"le_double.ply", binaryPly<double, std::int32_t>(false, "double", "int")},
          {"be_double.ply", binaryPly<double, std::uint32_t>(true, "float64", "uint32")},
          {"le_char.ply", binaryPly<float, std::int8_t>(false, "float", "char")}};
}
std::vector<Flavour> allFlavours() {
  std::vector<Flavour> flavours = plyFlavours();
  flavours.push_back({"a.obj", objText()});
  flavours.push_back({"a.OFF", offText()});
  flavours.push_back({"ascii.stl", asciiStl()});
  flavours.push_back({"binary.stl", binaryStl()});
  return flavours;
}

// Sizes to cut a file to: every one of the last 60, some before.
std::vector<std::size_t> chooseCuts(std::size_t end) {
  std::vector<std::size_t> cuts;
  for (std::size_t size = 0; size < end; size += size + 60 < end ? 11 : 1) cuts.push_back(size);
  return cuts;
}

}  // namespace

TEST_F(MeshReader, ReadsEveryFormatAsStoredPlainAndGzipped) {
  const std::vector<glm::vec3> expected = unroll(kPoints, kTriangles);
  for (const Flavour& flavour : allFlavours()) {
    for (const fs::path& path :
         {write(flavour.file, flavour.bytes), writeGzipped(flavour.file + ".gz", flavour.bytes)}) {
      SCOPED_TRACE(path);
      const MeshFile mesh = readMeshFile(path);
      EXPECT_EQ(unroll(mesh.positions, mesh.triangles), expected);
      const bool stl = flavour.file.ends_with(".stl");
      EXPECT_EQ(mesh.polygonsSplit, stl ? 0u : 1u);
      if (!stl) {
        EXPECT_EQ(mesh.positions, kPoints);
        EXPECT_EQ(mesh.triangles, kTriangles);
      }
    }
  }
}

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

TEST_F(MeshReader, KeepsWhatOtherElementsOfAPlySurround) {
  std::string text = asciiPly();
  text.replace(text.find("end_header\n0"), 11,
               "element edge 1\nproperty list uchar int v\nend_header\n");
  EXPECT_EQ(readMeshFile(write("after.ply", text + "2 0 1\n")).triangles, kTriangles);
  text = binaryPly<float, std::uint8_t>(false, "float", "uchar");
  text.replace(text.find("element vertex 5"), 0, "element camera 2\nproperty short a\n");
  text.replace(text.find("quality\nend_header\n") + 19, 0, "abcd");
  EXPECT_EQ(readMeshFile(write("before.ply", text)).positions, kPoints);
}

TEST_F(MeshReader, ReadsPlyWithCarriageReturns) {
  std::string text = asciiPly();
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.replace(at, 1, "\r\n");
  EXPECT_EQ(readMeshFile(write("dos.ply", text)).triangles, kTriangles);
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

TEST_F(MeshReader, ReadsOffWithItsCountsOnTheFirstLineOrWithoutKeyword) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2";
  for (const char* head : {"OFF 3 1 0\n", "OFF3 1 0\n", "3 1\n", "COFF\n3 1 0\n"})
    EXPECT_EQ(readMeshFile(write("a.off", head + body)).triangles.size(), 1u) << head;
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

// HLODBENCH_MODELS: a folder of *.ply or *.ply.zst (unpacked here by the zstd program).
TEST_F(MeshReader, ReadsRealMeshesAsTheirHeadersSay) {
  const char* models = std::getenv("HLODBENCH_MODELS");
  if (models == nullptr) GTEST_SKIP() << "set HLODBENCH_MODELS to a folder of *.ply[.zst]";
  int read = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(models)) {
    fs::path path = entry.path();
    if (path.extension() == ".zst") {
      path = folder_ / "model.ply";
      const std::string command =
          "zstd -dqcf '" + entry.path().string() + "' > '" + path.string() + "'";
      ASSERT_EQ(std::system(command.c_str()), 0) << command;
    }
    if (path.extension() != ".ply") continue;
    std::ifstream in(path, std::ios::binary);
    std::size_t vertices = 0, faces = 0;
    for (std::string line; std::getline(in, line) && line != "end_header";) {
      if (line.starts_with("element vertex ")) vertices = std::stoul(line.substr(15));
      if (line.starts_with("element face ")) faces = std::stoul(line.substr(13));
    }
    const auto start = std::chrono::steady_clock::now();
    const MeshFile mesh = readMeshFile(path);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    std::printf("%s: %.2f s\n", entry.path().filename().c_str(), took.count());
    EXPECT_EQ(mesh.positions.size(), vertices) << entry.path();
    EXPECT_GE(mesh.triangles.size(), faces) << entry.path();
    ++read;
  }
  EXPECT_GT(read, 0) << "no *.ply or *.ply.zst in " << models;
}

}  // namespace hlodbench
