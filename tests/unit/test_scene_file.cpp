#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hlod/core/error.h"
#include "hlod/scene/scene_description.h"
#include "hlod/scene/scene_file.h"

namespace hlodbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

// A tetrahedron whose box is 2..4, 10..14, -1..0: three vertices low, one high.
constexpr const char* kTetrahedron =
    "v 2 10 -1\nv 4 10 -1\nv 2 10 0\nv 2 14 -1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";

class SceneFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("hlodbench_scene_") + info->name());
    fs::create_directories(folder_ / "meshes");
    std::ofstream(folder_ / "meshes/tetra.obj") << kTetrahedron;
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path write(const std::string& text) const {
    std::ofstream(folder_ / "a.scene.json") << text;
    return folder_ / "a.scene.json";
  }
  [[nodiscard]] static json sceneOf(const json& instances) {
    return {{"version", 1},
            {"name", "test"},
            {"meshes", {{"tetra", {{"file", "meshes/tetra.obj"}}}}},
            {"instances", instances}};
  }
  [[nodiscard]] TriangleMesh place(json instance) const {
    instance["mesh"] = "tetra";
    return readScene(write(sceneOf(json::array({instance})).dump())).mesh;
  }
  [[nodiscard]] std::string readError(const std::string& text) const {
    const fs::path path = write(text);
    try {
      readScene(path);
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      EXPECT_EQ(what.rfind(path.string() + ": ", 0), 0u) << what;
      return what;
    }
    ADD_FAILURE() << "was read: " << text;
    return "";
  }
  [[nodiscard]] std::string readError(const json& scene) const { return readError(scene.dump()); }

  fs::path folder_;
};

void expectNear(const glm::vec3& found, const glm::vec3& expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-5) << i;
}

// Six times the volume that the triangles enclose; positive when they face outwards.
double computeVolume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (const glm::uvec3& t : mesh.triangles)
    volume +=
        glm::dot(glm::dvec3(mesh.positions[t.x]),
                 glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])));
  return volume;
}

}  // namespace

TEST_F(SceneFile, LeavesAnInstanceWithoutTransformAsStored) {
  const TriangleMesh mesh = place(json::object());
  ASSERT_EQ(mesh.positions.size(), 4u);
  EXPECT_EQ(mesh.positions[3], glm::vec3(2, 14, -1));
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 3, 1));
  EXPECT_EQ(mesh.objects, std::vector<std::uint32_t>(4, 0));
}

TEST_F(SceneFile, ScalesThenRotatesThenTranslates) {
  const json rotate = {{"axis", {0, 5, 0}}, {"degrees", 90}};
  const TriangleMesh mesh =
      place({{"scale", {2, 1, 3}}, {"rotate", rotate}, {"translate", {100, 0, 0}}});
  // (4, 10, -1) -> (8, 10, -3) -> a quarter turn about y takes x to -z, z to x -> (-3, 10, -8).
  expectNear(mesh.positions[1], {97, 10, -8});
}

TEST_F(SceneFile, NormalizesToUnitSizeOnTheGroundFirst) {
  const TriangleMesh mesh = place({{"normalize", true}, {"scale", 2}, {"translate", {0, 1, 0}}});
  // The box is 2 x 4 x 1: its height becomes 1, then 2.
  expectNear(mesh.positions[0], {-0.5f, 1, -0.25f});
  expectNear(mesh.positions[3], {-0.5f, 3, -0.25f});
  expectNear(mesh.positions[1], {0.5f, 1, -0.25f});
}

TEST_F(SceneFile, TurnsAZUpSceneUpright) {
  json scene = sceneOf({{{"mesh", "tetra"}, {"normalize", true}}});
  scene["up"] = "z";
  const TriangleMesh mesh = readScene(write(scene.dump())).mesh;
  float lowest = 1.0f;
  for (const glm::vec3& p : mesh.positions) lowest = std::min(lowest, p.y);
  EXPECT_NEAR(lowest, 0.0f, 1e-6);
  // z, from -1 to 0 of an extent of 4, has become y; y, centred at 12, has become -z.
  expectNear(mesh.positions[2], {-0.25f, 0.25f, 0.5f});
  EXPECT_NEAR(computeVolume(mesh), 8.0 / 64.0, 1e-5);
}

TEST_F(SceneFile, ReadsAMatrixRowByRow) {
  const TriangleMesh mesh = place({{"matrix", {1, 0, 0, 5, 0, 0, -1, 6, 0, 1, 0, 7, 0, 0, 0, 1}}});
  expectNear(mesh.positions[3], {7, 7, 21});
}

TEST_F(SceneFile, KeepsSurfacesFacingOutwardsUnderAnyTransform) {
  const std::vector<json> instances{
      json::object(),
      {{"scale", {1, 2, 3}}, {"rotate", {{"axis", {1, 2, 3}}, {"degrees", 200}}}},
      {{"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}},
      {{"matrix", {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}, {"normalize", true}}};
  for (const json& instance : instances) EXPECT_GT(computeVolume(place(instance)), 0.0) << instance;
}

TEST_F(SceneFile, FlattensManyInstancesInOrder) {
  const json instances = {{{"mesh", "tetra"}},
                          {{"mesh", "tetra"}, {"name", "b"}, {"color", {0, 0.5, 1}}},
                          {{"mesh", "tetra"}, {"translate", {9, 0, 0}}}};
  std::vector<std::string> stages;
  const Scene scene =
      readScene(write(sceneOf(instances).dump()), [&](const std::string& stage, double share) {
        EXPECT_GE(share, 0.0);
        EXPECT_LE(share, 1.0);
        stages.push_back(stage);
      });
  EXPECT_EQ(scene.name, "test");
  EXPECT_EQ(std::count(stages.begin(), stages.end(), "reading tetra.obj"), 1);  // read once
  const TriangleMesh& mesh = scene.mesh;
  ASSERT_EQ(mesh.triangles.size(), 12u);
  ASSERT_EQ(mesh.objects.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(mesh.objects[i], i / 4);
    EXPECT_EQ(mesh.triangles[i] - mesh.triangles[i % 4], glm::uvec3(4 * (i / 4)));
  }
  ASSERT_EQ(mesh.objectTable.size(), 3u);
  EXPECT_EQ(mesh.objectTable[0].name, "tetra 0");
  EXPECT_EQ(mesh.objectTable[1].name, "b");
  EXPECT_EQ(mesh.objectTable[1].color, glm::vec3(0, 0.5f, 1));
  EXPECT_EQ(mesh.positions[8], mesh.positions[0] + glm::vec3(9, 0, 0));
}

TEST_F(SceneFile, GivesNeighboursClearlyDifferentColours) {
  for (std::size_t i = 0; i < 40; ++i) {
    const glm::vec3 color = choosePaletteColor(i);
    EXPECT_TRUE(glm::all(glm::greaterThan(color, glm::vec3(0.05f)))) << i;
    EXPECT_TRUE(glm::all(glm::lessThan(color, glm::vec3(1.0f)))) << i;
    for (std::size_t j = i + 1; j < i + 4; ++j)
      EXPECT_GT(glm::length(choosePaletteColor(j) - color), 0.15f) << i << ' ' << j;
  }
}

TEST_F(SceneFile, ExpandsVariablesInMeshPaths) {
  const auto read = [&](const std::string& file) {
    json scene = sceneOf({{{"mesh", "tetra"}}});
    scene["meshes"]["tetra"]["file"] = file;
    return readScene(write(scene.dump())).mesh.triangles.size();
  };
  unsetenv("HLODBENCH_TEST_DIR");
  EXPECT_EQ(read("${HLODBENCH_TEST_DIR:-meshes}/tetra.obj"), 4u);
  setenv("HLODBENCH_TEST_DIR", "", 1);
  EXPECT_EQ(read("${HLODBENCH_TEST_DIR:-meshes}/tetra.obj"), 4u);
  setenv("HLODBENCH_TEST_DIR", (folder_ / "meshes").c_str(), 1);
  EXPECT_EQ(read("${HLODBENCH_TEST_DIR:-nowhere}/tetra.obj"), 4u);
  EXPECT_EQ(read("${HLODBENCH_TEST_DIR}/${HLODBENCH_TEST_NONE:-tetra}.obj"), 4u);
  unsetenv("HLODBENCH_TEST_DIR");
}

TEST_F(SceneFile, ReadsABareMeshAsOneInstance) {
  const Scene scene = readScene(folder_ / "meshes/tetra.obj");
  EXPECT_EQ(scene.name, "tetra");
  EXPECT_EQ(scene.mesh.triangles.size(), 4u);
  EXPECT_EQ(scene.mesh.objects, std::vector<std::uint32_t>(4, 0));
  ASSERT_EQ(scene.mesh.objectTable.size(), 1u);
}

TEST_F(SceneFile, ReadsAGenerator) {
  const auto read = [&](const std::string& generator) {
    return readSceneDescription(
        write(R"({"version": 1, "name": "c", "generator": )" + generator + "}"));
  };
  const SceneDescription scene =
      read(R"({"type": "courtyard", "seed": 18446744073709551615, "triangles": 60000})");
  ASSERT_TRUE(scene.courtyard);
  EXPECT_EQ(scene.courtyard->seed, 18446744073709551615u);
  EXPECT_EQ(scene.courtyard->triangles, 60000u);
  EXPECT_EQ(read(R"({"type": "courtyard"})").courtyard->triangles, CourtyardOptions{}.triangles);
}

TEST_F(SceneFile, NamesThePlaceOfEachFault) {
  const json good = sceneOf({{{"mesh", "tetra"}}});
  const auto with = [&](const std::string& pointer, const json& value) {
    json scene = good;
    scene[json::json_pointer(pointer)] = value;
    return readError(scene);
  };
  const std::vector<std::tuple<std::string, json, std::string>> cases{
      {"/version", 2, "/version: expected 1, found 2"},
      {"/name", "", "/name: expected a text that is not empty, found \"\""},
      {"/up", "x", "/up: expected \"y\" or \"z\", found \"x\""},
      {"/light", 1, "/light: unknown key; known are version, name, up"},
      {"/meshes/tetra/scale", 1, "/meshes/tetra/scale: unknown key"},
      {"/meshes/tetra/file", "no.ply", "/meshes/tetra/file: no file "},
      {"/meshes/tetra/file", "${HLODBENCH_NONE}/a.ply", "variable 'HLODBENCH_NONE' is not set"},
      {"/meshes/tetra/file", "${HLODBENCH_NONE", "/meshes/tetra/file: expected a } after each ${"},
      {"/meshes/tetra/file", "dragon_vrip.ply.gz", "; scripts/fetch_dragon.sh gets it"},
      {"/meshes/other", {{"file", "meshes/tetra.obj"}}, "/meshes/other: no instance uses this"},
      {"/instances", json::array(), "/instances: expected an array of 1 or more entries"},
      {"/instances/0/mesh", "ball", "/instances/0/mesh: expected a key of /meshes"},
      {"/instances/0/scale", -1, "/instances/0/scale: expected a number above 0, found -1"},
      {"/instances/0/scale", 0, "/instances/0/scale: expected a number above 0, found 0"},
      {"/instances/0/scale", {1, 0, 1}, "/instances/0/scale/1: expected a number above 0"},
      {"/instances/0/scale", {1, 1}, "/instances/0/scale: expected an array of 3 entries"},
      {"/instances/0/translate", {1, "a", 1}, "/instances/0/translate/1: expected a number"},
      {"/instances/0/color", {0, 0, 2}, "/instances/0/color/2: expected a number from 0 to 1"},
      {"/instances/0/rotate",
       {{"axis", {0, 0, 0}}, {"degrees", 1}},
       "rotate/axis: expected an axis"},
      {"/instances/0/rotate", {{"axis", {0, 0, 1}}}, "rotate: the key \"degrees\" is missing"},
      {"/instances/0/matrix", std::vector<int>(16, 0), "matrix: expected a last row of 0 0 0 1"},
      {"/instances/0/matrix", std::vector<int>(15, 0), "matrix: expected an array of 16 entries"},
      {"/instances/0/normalize", 1, "/instances/0/normalize: expected true or false"},
      {"/instances/0/translate", {1e300, 0, 0}, "/instances/0: expected finite coordinates"},
      {"/generator", {{"type", "courtyard"}}, "/instances: unknown key"}};
  for (const auto& [pointer, value, message] : cases)
    EXPECT_THAT(with(pointer, value), HasSubstr(message));
  EXPECT_THAT(with("/instances/0/a~0b~1c", 1), HasSubstr(": /instances/0/a~0b~1c: unknown key"));
}

TEST_F(SceneFile, RefusesWhatIsNoScene) {
  EXPECT_THAT(readError(std::string("{\"version\": 1,\n\"name\" 2}")), HasSubstr("line 2"));
  EXPECT_THAT(readError(std::string("")), HasSubstr("expected JSON"));
  EXPECT_THAT(readError(std::string("[]")), HasSubstr("/: expected an object, found []"));
  EXPECT_THAT(readError(std::string(R"({"version": 1, "version": 1})")),
              HasSubstr("the key \"version\" stands twice"));
  json scene = sceneOf({{{"mesh", "tetra"}}});
  scene["instances"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  scene["instances"][0]["scale"] = 2;
  EXPECT_THAT(readError(scene), HasSubstr("/instances/0/scale: cannot stand beside \"matrix\""));
  scene["instances"][0].erase("scale");
  scene["instances"][0]["matrix"][10] = 0;
  EXPECT_THAT(readError(scene), HasSubstr("/instances/0/matrix: expected a matrix whose"));
  EXPECT_THROW(readScene(folder_ / "none.scene.json"), InputError);
  EXPECT_THROW(readScene(folder_ / "none.ply"), InputError);
  EXPECT_THROW(computeSceneHash(folder_ / "none.ply"), InputError);
}

TEST_F(SceneFile, HashFollowsEveryByteOfSceneAndMeshes) {
  json scene = sceneOf({{{"mesh", "tetra"}}});
  const std::uint64_t first = computeSceneHash(write(scene.dump()));
  EXPECT_EQ(computeSceneHash(write(scene.dump())), first);
  EXPECT_NE(computeSceneHash(write(scene.dump() + " ")), first);
  const fs::path path = write(scene.dump());
  const std::uint64_t bare = computeSceneHash(folder_ / "meshes/tetra.obj");
  std::ofstream(folder_ / "meshes/tetra.obj", std::ios::app) << "#";
  EXPECT_NE(computeSceneHash(path), first);
  EXPECT_NE(computeSceneHash(folder_ / "meshes/tetra.obj"), bare);
}

}  // namespace hlodbench
