#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "hlod/core/error.h"
#include "hlod/scene/mesh_reader.h"

// One small mesh written in every format that the mesh reader knows, and the tests' fixture.

namespace hlodbench {

namespace fs = std::filesystem;

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
  // A file's own path, or that of its unpacked copy when it is packed by the zstd program.
  fs::path unpack(const fs::path& path) const {
    if (path.extension() != ".zst") return path;
    const fs::path copy = folder_ / "model.ply";
    const std::string command = "zstd -dqcf '" + path.string() + "' > '" + copy.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return copy;
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
inline const std::vector<glm::vec3> kPoints{
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 0.25f, 2}};
inline const std::vector<std::vector<int>> kFaces{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4},
                                                  {3, 0, 4},    {0, 1, 4}, {1, 1, 4}};
inline const std::vector<glm::uvec3> kTriangles{{0, 3, 2}, {0, 2, 1}, {0, 1, 4}, {1, 2, 4},
                                                {2, 3, 4}, {3, 0, 4}, {0, 1, 4}, {1, 1, 4}};

inline std::string coordinates(const glm::vec3& p) {
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

inline std::string plyHeader(const std::string& format, const std::string& real = "float",
                             const std::string& faceList = "list uchar int vertex_indices") {
  return "ply\nformat " + format + " 1.0\ncomment element vertex 7 end_header\n" +
         "obj_info element face 3\nelement vertex 5\nproperty " + real + " x\nproperty " + real +
         " y\nproperty " + real + " z\nproperty uchar red\nelement face 7\nproperty " + faceList +
         "\nproperty short quality\nend_header\n";
}

inline std::string asciiPly() {
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

inline std::string objText() {
  std::string text = "# pyramid\nmtllib no_such_file.mtl\no body\n";
  for (std::size_t i = 0; i < kPoints.size(); ++i)
    text += "v " + coordinates(kPoints[i]) + (i == 2 ? " 0.5 0.5 0.5\r\n" : "\n");
  text += "vn 0 0 1\nvt 0 0\nusemtl brick\ns off\n";
  text += "f 1 4 \\\n3 2\n";        // continued
  text += "f 1/1/1 2/1/1 5/1/1\n";  // all three
  text += "f -4//1 -3//1 -1//1\nf 3/1 4/1 5/1 # note\n\tf 4 1 5\nf 1 2 5\nf 2 2 5\n";
  return text;
}

inline std::string offText() {
  std::string text = "OFF # comment\n# another\n\n5 7 0\n";
  for (const glm::vec3& p : kPoints) text += coordinates(p) + " # vertex\n";
  for (const auto& face : kFaces) {
    text += std::to_string(face.size());
    for (const int corner : face) (text += "  ") += std::to_string(corner);
    text += " 255 0 0\n\n";
  }
  return text;
}

inline std::string asciiStl() {
  std::string text = "solid pyramid\n";
  for (const glm::uvec3& t : kTriangles) {
    text += "  facet normal nan 0 0\n    outer loop\n";
    for (int i = 0; i < 3; ++i) text += "      vertex " + coordinates(kPoints[t[i]]) + "\n";
    text += "    ENDLOOP\n  endfacet\n";
  }
  return text + "endsolid pyramid\n";
}

inline std::string binaryStl() {
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
inline std::vector<glm::vec3> unroll(const std::vector<glm::vec3>& points,
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
inline std::vector<Flavour> plyFlavours() {
  return {{"a.ply", asciiPly()},
          {"le.ply", binaryPly<float, std::uint8_t>(false, "float", "uchar")},
          {"be.ply", binaryPly<float, std::uint8_t>(true, "float32", "uint8")},
          {"le_double.ply", binaryPly<double, std::int32_t>(false, "double", "int")},
          {"be_double.ply", binaryPly<double, std::uint32_t>(true, "float64", "uint32")},
          {"le_char.ply", binaryPly<float, std::int8_t>(false, "float", "char")}};
}
inline std::vector<Flavour> allFlavours() {
  std::vector<Flavour> flavours = plyFlavours();
  flavours.push_back({"a.obj", objText()});
  flavours.push_back({"a.OFF", offText()});
  flavours.push_back({"ascii.stl", asciiStl()});
  flavours.push_back({"binary.stl", binaryStl()});
  return flavours;
}

}  // namespace hlodbench
