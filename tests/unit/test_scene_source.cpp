#include <nlohmann/json.hpp>

#include "hlod/scene/scene_file.h"
#include "hlod/scene/scene_source.h"
#include "mesh_samples.h"

// Scenes whose meshes may stay in their files, compared with the same scenes flattened.

namespace hlodbench {
namespace {

class SceneSource : public MeshReader {
 protected:
  // The faces of the pyramid as triangles, some of its coordinates -0.
  static std::string pyramid(bool bigEndian) {
    std::string bytes = bigEndian ? "ply\nformat binary_big_endian 1.0\n"
                                  : "ply\nformat binary_little_endian 1.0\n";
    bytes +=
        "element vertex 6\nproperty float x\nproperty float y\nproperty float z\nelement face 8\n"
        "property list uchar int vertex_indices\nend_header\n";
    std::vector<glm::vec3> points = kPoints;
    points[0] = -points[0];
    points.emplace_back(-7.0f, 3.0f, -2.0f);  // which nobody uses
    for (const glm::vec3& p : points)
      for (int i = 0; i < 3; ++i) append(bytes, p[i], bigEndian);
    for (const glm::uvec3& t : kTriangles) {
      bytes += '\3';
      for (int i = 0; i < 3; ++i) append(bytes, t[i], bigEndian);
    }
    return bytes;
  }

  // Compared bit by bit: -0 is not 0.
  static void expectFlattened(const fs::path& path) {
    const Scene scene = readScene(path);
    const MeshTriangles expected(scene.mesh);
    for (const MeshPlace place : {MeshPlace::kMemory, MeshPlace::kFile}) {
      const std::unique_ptr<TriangleSource> source = openScene(path, place);
      ASSERT_EQ(source->triangleCount(), expected.triangleCount()) << path;
      std::vector<SceneTriangle> a(source->triangleCount()), b = a;
      source->read(0, a);
      expected.read(0, b);
      EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b))))
          << path;
      ASSERT_EQ(source->objects().size(), expected.objects().size());
      for (std::size_t i = 0; i < expected.objects().size(); ++i) {
        EXPECT_EQ(source->objects()[i].name, expected.objects()[i].name);
        EXPECT_EQ(source->objects()[i].color, expected.objects()[i].color);
      }
    }
  }
};

TEST_F(SceneSource, HandsOutABareMeshAsItIsFlattened) {
  expectFlattened(write("in_place.ply", pyramid(false)));
  expectFlattened(write("in_memory.ply", pyramid(true)));
  expectFlattened(write("with_quads.ply", binaryPly<float, std::uint8_t>(false, "float", "uchar")));
  expectFlattened(write("a.obj", objText()));
  expectFlattened(writeGzipped("a.more.ply.gz", pyramid(false)));
  EXPECT_EQ(openScene(folder_ / "in_place.ply", MeshPlace::kFile)->memoryBytes(), 0u);
  EXPECT_GT(openScene(folder_ / "in_memory.ply", MeshPlace::kFile)->memoryBytes(), 0u);
}

TEST_F(SceneSource, HandsOutInstancesAsTheyAreFlattened) {
  write("in_place.ply", pyramid(false));
  write("in_memory.ply", pyramid(true));
  const nlohmann::json scene{
      {"version", 1},
      {"name", "test"},
      {"up", "z"},
      {"meshes", {{"a", {{"file", "in_place.ply"}}}, {"b", {{"file", "in_memory.ply"}}}}},
      {"instances",
       {{{"mesh", "a"}},
        {{"mesh", "b"}, {"translate", {1, 2, 3}}},
        {{"mesh", "a"}, {"normalize", true}, {"rotate", {{"axis", {1, 2, 3}}, {"degrees", 20}}}},
        {{"mesh", "a"}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}}};
  expectFlattened(write("a.scene.json", scene.dump()));
  EXPECT_EQ(openScene(folder_ / "a.scene.json", MeshPlace::kFile)->memoryBytes(),
            6 * 12u + 8 * 12u);
}

}  // namespace
}  // namespace hlodbench
