#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "mesh_samples.h"

namespace hlodbench {

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

TEST_F(MeshReader, ReadsOffWithItsCountsOnTheFirstLineOrWithoutKeyword) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2";
  for (const char* head : {"OFF 3 1 0\n", "OFF3 1 0\n", "3 1\n", "COFF\n3 1 0\n"})
    EXPECT_EQ(readMeshFile(write("a.off", head + body)).triangles.size(), 1u) << head;
}

TEST_F(MeshReader, SkipsVertexPropertiesOfAnyNameAndType) {
  const std::vector<std::pair<std::string, std::size_t>> types{
      {"char", 1}, {"ushort", 2}, {"int32", 4}, {"float", 4}, {"double", 8}};
  for (const auto& [type, size] : types) {
    for (const char* name : {"red", "alpha", "nx", "u", "confidence"}) {
      std::string bytes = binaryPly<float, std::uint8_t>(false, "float", "uchar");
      const std::string from = "property uchar red\n";
      bytes.replace(bytes.find(from), from.size(), "property " + type + " " + name + "\n");
      const std::size_t body = bytes.find("\nend_header\n") + 12;
      for (std::size_t i = kPoints.size(); i-- > 0;)
        bytes.insert(body + i * 13 + 12, std::string(size - 1, '\x7f'));
      const MeshFile mesh = readMeshFile(write("a.ply", bytes));
      EXPECT_EQ(mesh.positions, kPoints) << type << ' ' << name;
      EXPECT_EQ(mesh.triangles, kTriangles) << type << ' ' << name;
    }
  }
}

// HLODBENCH_MODELS: a folder of *.ply or *.ply.zst.
TEST_F(MeshReader, ReadsRealMeshesAsTheirHeadersSay) {
  const char* models = std::getenv("HLODBENCH_MODELS");
  if (models == nullptr) GTEST_SKIP() << "set HLODBENCH_MODELS to a folder of *.ply[.zst]";
  int read = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(models)) {
    const fs::path path = unpack(entry.path());
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
