#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>

#include "hlod/scene/ply_mesh.h"
#include "mesh_samples.h"

// PLY files that are read piece by piece, compared with the reader that takes them whole.

namespace hlodbench {
namespace {

using ::testing::HasSubstr;

// A triangulated grid, in a binary PLY of some kind.
struct GridPly {
  std::uint32_t side = 8;  // quads
  std::string real = "float";
  std::string count = "uchar";
  bool shuffled = false;   // its vertices
  bool surrounded = true;  // by other elements and properties

  [[nodiscard]] std::string bytes() const {
    const std::uint32_t columns = side + 1;
    std::vector<std::uint32_t> numbers(columns * columns);
    std::iota(numbers.begin(), numbers.end(), 0);
    if (shuffled) std::shuffle(numbers.begin(), numbers.end(), std::mt19937(5));
    std::vector<glm::vec3> points(numbers.size());
    for (std::uint32_t i = 0; i < numbers.size(); ++i)
      points[numbers[i]] = {i % columns, i / columns, std::sin(0.1f * static_cast<float>(i))};
    std::string out = header(points.size());
    if (surrounded) out += "ab";
    for (const glm::vec3& p : points) addVertex(p, out);
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        const std::uint32_t a = y * columns + x;
        const std::uint32_t b = a + columns;
        addFace({numbers[a], numbers[a + 1], numbers[b + 1]}, out);
        addFace({numbers[a], numbers[b + 1], numbers[b]}, out);
      }
    return surrounded ? out + "something else" : out;
  }

  [[nodiscard]] std::size_t vertexSize() const {
    return (real == "double" ? 24 : 12) + (surrounded ? 3 : 0);
  }

 private:
  [[nodiscard]] std::string header(std::size_t vertices) const {
    const std::string axis = "property " + real + ' ';
    const std::string other = surrounded ? "property short nx\n" : "";
    return "ply\nformat binary_little_endian 1.0\ncomment a grid\n" +
           std::string(surrounded ? "element camera 1\nproperty short a\n" : "") +
           "element vertex " + std::to_string(vertices) + '\n' +
           (surrounded ? "property uchar red\n" : "") + axis + "x\n" + axis + "y\n" + other + axis +
           "z\nelement face " + std::to_string(2 * side * side) + "\nproperty list " + count +
           " int vertex_indices\n" + other +
           (surrounded ? "element end 1\nproperty list uchar int v\n" : "") + "end_header\n";
  }
  void addNumber(float value, std::string& out) const {
    if (real == "double")
      append(out, double{value}, false);
    else
      append(out, value, false);
  }
  void addVertex(const glm::vec3& p, std::string& out) const {
    if (surrounded) out += '\xff';
    addNumber(p.x, out);
    addNumber(p.y, out);
    if (surrounded) out += "nx";
    addNumber(p.z, out);
  }
  void addFace(const std::array<std::uint32_t, 3>& corners, std::string& out) const {
    if (count == "int" || count == "uint")
      append(out, std::uint32_t{3}, false);
    else
      out += '\3';
    for (const std::uint32_t corner : corners) append(out, corner, false);
    if (surrounded) out += "nx";
  }
};

std::vector<GridPly> grids(std::uint32_t side) {
  return {{side, "float", "uchar", false, false}, {side, "float", "char", true, true},
          {side, "double", "int", true, false},   {side, "double", "uint", false, true},
          {side, "double", "uchar", true, true},  {side, "float", "int", false, true}};
}

std::vector<SceneTriangle> readAll(const MeshSource& mesh, std::size_t piece) {
  std::vector<SceneTriangle> triangles(mesh.extent().triangles);
  for (std::size_t first = 0; first < triangles.size(); first += piece) {
    const std::size_t count = std::min(piece, triangles.size() - first);
    mesh.read(first, std::span(triangles).subspan(first, count));
  }
  return triangles;
}

void expectSame(const MeshSource& a, const MeshSource& b, std::size_t piece) {
  EXPECT_EQ(a.extent().vertices, b.extent().vertices);
  EXPECT_EQ(a.extent().box.min, b.extent().box.min);
  EXPECT_EQ(a.extent().box.max, b.extent().box.max);
  ASSERT_EQ(a.extent().triangles, b.extent().triangles);
  EXPECT_EQ(a.computePartSize(), b.computePartSize());
  const std::vector<SceneTriangle> left = readAll(a, piece);
  const std::vector<SceneTriangle> right = readAll(b, left.size());
  for (std::size_t i = 0; i < left.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      ASSERT_EQ(left[i].corners[corner], right[i].corners[corner]) << i;
}

// What opening a mesh says when it fails, else "".
std::string fault(const fs::path& path, MeshPlace place) {
  try {
    openMesh(path, place);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class PlyMesh : public MeshReader {
 protected:
  // Both ways of reading find the same; whether the one of the file found a fault itself.
  bool findsTheSame(const std::string& bytes) const {
    const fs::path path = write("a.ply", bytes);
    const std::string expected = fault(path, MeshPlace::kMemory);
    EXPECT_EQ(fault(path, MeshPlace::kFile), expected);
    if (!expected.empty()) {
      try {
        return openPlyMesh(path) != nullptr;
      } catch (const InputError&) {
        return true;
      }
    }
    expectSame(*openMesh(path, MeshPlace::kFile), *openMesh(path, MeshPlace::kMemory), 7);
    return false;
  }
  std::string errorOfRead(const MeshSource& mesh) const {
    try {
      readAll(mesh, 100);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(PlyMesh, HandsOutTheTrianglesOfTheFile) {
  for (const GridPly& grid : grids(40)) {
    const fs::path path = write("a.PLY", grid.bytes());
    const std::unique_ptr<MeshSource> mesh = openPlyMesh(path);
    ASSERT_TRUE(mesh) << grid.real << ' ' << grid.count;
    EXPECT_EQ(mesh->memoryBytes(), 0u);
    for (const std::size_t piece : {1, 6, 100000})
      expectSame(*mesh, *openMesh(path, MeshPlace::kMemory), piece);
  }
}

// More vertices than are read at once, in any order, and more triangles.
TEST_F(PlyMesh, FetchesVerticesFromAllOverALargeFile) {
  const GridPly grid{260, "double", "uchar", true, true};
  const fs::path path = write("a.ply", grid.bytes());
  const std::unique_ptr<MeshSource> mesh = openPlyMesh(path);
  ASSERT_TRUE(mesh);
  for (const std::size_t piece : {5, 16384, 1000000})
    expectSame(*mesh, *openMesh(path, MeshPlace::kMemory), piece);
}

TEST_F(PlyMesh, FollowsALink) {
  const fs::path path = write("a.ply", GridPly().bytes());
  fs::create_symlink(path, folder_ / "link.ply");
  const std::unique_ptr<MeshSource> mesh = openPlyMesh(folder_ / "link.ply");
  ASSERT_TRUE(mesh);
  expectSame(*mesh, *openMesh(path, MeshPlace::kMemory), 50);
}

TEST_F(PlyMesh, LeavesOtherFilesToTheOtherReader) {
  for (const Flavour& flavour : allFlavours())  // all have a face of 4 corners
    EXPECT_FALSE(openPlyMesh(write(flavour.file, flavour.bytes))) << flavour.file;
  const std::string bytes = GridPly().bytes();
  EXPECT_FALSE(openPlyMesh(writeGzipped("a.ply.gz", bytes)));
  EXPECT_FALSE(openPlyMesh(folder_));
  EXPECT_FALSE(openPlyMesh(folder_ / "none.ply"));
  std::string changed = bytes;
  changed.replace(changed.find(" int vertex"), 4, " short");
  EXPECT_FALSE(openPlyMesh(write("short.ply", changed)));
  EXPECT_FALSE(openPlyMesh(
      write("faces_first.ply",
            "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uchar int "
            "vertex_indices\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
            "float z\nend_header\n" +
                std::string(49, '\3'))));
  changed = bytes;
  changed.replace(changed.find("comment"), 7, "comment " + std::string(100000, 'x'));
  EXPECT_FALSE(openPlyMesh(write("long_header.ply", changed)));
  expectSame(*openMesh(folder_ / "long_header.ply", MeshPlace::kFile),
             *openMesh(write("b.ply", bytes), MeshPlace::kFile), 9);
}

TEST_F(PlyMesh, FindsTheSameWhereverAFileIsCut) {
  for (const GridPly& grid : grids(3)) {
    const std::string bytes = grid.bytes();
    const std::size_t end = grid.surrounded ? bytes.size() - 14 : bytes.size();
    int found = 0;
    for (std::size_t size = 0; size < end; ++size) {
      SCOPED_TRACE(grid.real + grid.count + " cut to " + std::to_string(size));
      found += findsTheSame(bytes.substr(0, size)) ? 1 : 0;
    }
    EXPECT_GT(found, 200);
    EXPECT_EQ(findsTheSame(bytes + "x"), !grid.surrounded);
  }
}

TEST_F(PlyMesh, FindsTheSameInFilesWithFaults) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::mt19937 random(11);
  for (const GridPly& grid : grids(4)) {
    const std::string good = grid.bytes();
    const std::size_t body = good.find("\nend_header\n") + 12;
    const std::size_t faces = body + (grid.surrounded ? 2 : 0) + 25 * grid.vertexSize();
    int found = 0;
    for (int round = 0; round < 400; ++round) {
      std::string bytes = good;
      for (int change = 0; change <= round % 3; ++change) {
        // counts and indices of faces, coordinates, anything
        const std::size_t at = (round % 2 == 0 ? faces : body) + random() % (good.size() - faces);
        std::string value(1, static_cast<char>(random() % 6));
        if (round % 5 == 0) value.clear(), append(value, nan, false);
        if (at + value.size() <= good.size()) bytes.replace(at, value.size(), value);
      }
      SCOPED_TRACE(grid.real + grid.count + " round " + std::to_string(round));
      found += findsTheSame(bytes) ? 1 : 0;
    }
    EXPECT_GT(found, 40);
  }
}

TEST_F(PlyMesh, FindsTheSameOfFacesAndVertices) {
  GridPly grid;
  grid.surrounded = false;
  const std::string good = grid.bytes();
  const std::size_t vertices = good.find("\nend_header\n") + 12;
  const std::size_t faces = vertices + 81 * grid.vertexSize();
  const auto change = [&](std::size_t at, const std::string& to) {
    return std::string(good).replace(at, to.size(), to);
  };
  const std::string nan("\0\0\xc0\x7f", 4);
  const std::vector<std::pair<std::string, std::string>> cases{
      {change(vertices + 12 * 7 + 4, nan), "vertex 7 (from 0): expected finite coordinates"},
      {change(vertices + 12 * 7 + 4, std::string("\0\0\x80\xff", 4)), "found 7 -inf"},
      {change(faces + 13 * 5 + 5, std::string("\x51\0\0\0", 4)),
       "face 5 (from 0): expected vertices 0 to 80, found vertex 81"},
      {change(faces + 13 * 5 + 5, std::string(4, '\xff')), "found vertex -1"},
      {change(faces + 13 * 5, "\2"), "face 5 (from 0): expected 3 corners or more, found 2"},
      {change(faces + 13 * 5, std::string(1, '\0')), "expected 3 corners or more, found 0"},
      {good.substr(0, good.size() - 1), "the file ends in face 127 (from 0) of 128"},
      {good + "xyz", "expected the end after 81 vertices and 128 faces, found 3 more bytes"},
      {change(vertices, std::string(81 * 12, '\0')), "none of the 128 triangles has any area"}};
  for (const auto& [bytes, message] : cases) {
    EXPECT_TRUE(findsTheSame(bytes)) << message;
    EXPECT_THAT(fault(folder_ / "a.ply", MeshPlace::kFile), HasSubstr(message));
  }
}

TEST_F(PlyMesh, SaysThatTheFileBecameAnotherMeanwhile) {
  GridPly grid;
  grid.surrounded = false;
  const std::string bytes = grid.bytes();
  const std::size_t vertices = bytes.find("\nend_header\n") + 12;
  const fs::path path = write("a.ply", bytes);
  const std::unique_ptr<MeshSource> mesh = openPlyMesh(path);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(errorOfRead(*mesh), "");
  write("a.ply", std::string(bytes).replace(vertices, 4, std::string("\0\0\xc0\x7f", 4)));
  EXPECT_EQ(errorOfRead(*mesh), path.string() + ": changed while it was read");
  write("a.ply", std::string(bytes).replace(bytes.size() - 1, 1, "\x7f"));
  EXPECT_THAT(errorOfRead(*mesh), HasSubstr("face 127 (from 0): expected vertices 0 to 80"));
  for (const std::size_t size : {bytes.size() - 1, vertices + 20, std::size_t{0}}) {
    write("a.ply", bytes);
    fs::resize_file(path, size);
    EXPECT_EQ(errorOfRead(*mesh), path.string() + ": truncated while it was read") << size;
  }
}

TEST_F(PlyMesh, HandsOutTheTrianglesOfRealMeshes) {
  const char* models = std::getenv("HLODBENCH_MODELS");
  if (models == nullptr) GTEST_SKIP() << "set HLODBENCH_MODELS to a folder of *.ply[.zst]";
  int inPlace = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(models)) {
    const fs::path path = unpack(entry.path());
    SCOPED_TRACE(entry.path());
    if (path.extension() != ".ply") continue;
    const std::unique_ptr<MeshSource> mesh = openPlyMesh(path);
    if (!mesh) continue;
    expectSame(*mesh, *openMesh(path, MeshPlace::kMemory), 16384);
    ++inPlace;
  }
  EXPECT_GT(inPlace, 0) << "no binary little-endian *.ply or *.ply.zst of triangles in " << models;
}

}  // namespace
}  // namespace hlodbench
