#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hlod/build/octree.h"
#include "hlod/core/error.h"
#include "mesh_helpers.h"

namespace hlodbench {
namespace {

TEST(Weld, JoinsEqualPositionsOfOneObjectOnly) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, -0.0f}, {0, 1, 0}, {-1, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 2, 5}};
  mesh.objects = {0, 0, 1};
  mesh.objectTable.resize(2);
  const WeldedMesh welded = computeWeldedMesh(mesh);
  EXPECT_EQ(welded.positionCount(), 4u);
  EXPECT_EQ(welded.positions.size(), 4u + 3u);
  EXPECT_EQ(welded.triangles[0].x, welded.triangles[1].x);  // 0 and -0
  EXPECT_NE(welded.triangles[0].x, welded.triangles[2].x);
  EXPECT_EQ(welded.positionIds[welded.triangles[0].x], welded.positionIds[welded.triangles[2].x]);
  EXPECT_EQ(welded.seams[welded.positionIds[welded.triangles[0].x]], 1);
  EXPECT_EQ(welded.seams[welded.positionIds[welded.triangles[0].y]], 0);
}

TEST(Weld, NormalsPointOutOfAClosedBodyAndAreUnitLength) {
  TriangleMesh mesh = testing::nastySoup(3);
  for (const glm::vec3& n : computeWeldedMesh(mesh).normals)
    EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
  const WeldedMesh sphere = computeWeldedMesh(testing::bumpySphere(60));
  for (std::size_t v = 0; v < sphere.positions.size(); ++v)
    EXPECT_GT(glm::dot(sphere.normals[v], sphere.positions[v] - glm::vec3(3, -2, 1)), 0.0f);
}

TEST(Weld, RefusesBadMeshesWithOneLine) {
  const auto messageOf = [](auto&& spoil) {
    TriangleMesh mesh = testing::bumpySphere(10);
    spoil(mesh);
    try {
      computeWeldedMesh(mesh);
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(messageOf([](TriangleMesh& m) { m = {}; }).find("at least one triangle"),
            std::string::npos);
  EXPECT_NE(messageOf([](TriangleMesh& m) { m.positions[7].y = std::nanf(""); }).find("vertex 7"),
            std::string::npos);
  EXPECT_NE(messageOf([](TriangleMesh& m) { m.triangles[5].z = 1u << 30; }).find("triangle 5"),
            std::string::npos);
  EXPECT_NE(messageOf([](TriangleMesh& m) { m.objects[4] = 9; }).find("triangle 4"),
            std::string::npos);
  EXPECT_NE(messageOf([](TriangleMesh& m) { m.objects.pop_back(); }).find("object"),
            std::string::npos);
  EXPECT_NE(messageOf([](TriangleMesh& m) {
              for (glm::vec3& p : m.positions) p.x = p.y = 1.0f;
            }).find("area"),
            std::string::npos);
}

void expectSound(const Octree& tree, const WeldedMesh& mesh, std::uint32_t limit) {
  ASSERT_EQ(tree.nodes[0].size(), mesh.triangles.size());
  std::uint32_t oversized = 0;
  for (NodeId id = 0; id < tree.nodes.size(); ++id) {
    const OctreeNode& node = tree.nodes[id];
    ASSERT_GT(node.size(), 0u);
    if (node.isLeaf()) {
      oversized += node.size() > limit ? 1 : 0;
      continue;
    }
    EXPECT_GT(node.size(), limit);
    EXPECT_GE(node.childCount, 2u);
    EXPECT_LE(node.childCount, 8u);
    std::uint32_t at = node.begin;
    for (NodeId child = node.firstChild; child < node.firstChild + node.childCount; ++child) {
      EXPECT_EQ(tree.nodes[child].parent, id);
      EXPECT_EQ(tree.nodes[child].level, node.level + 1);
      EXPECT_EQ(tree.nodes[child].begin, at);
      EXPECT_TRUE(node.box.contains(tree.nodes[child].box));
      at = tree.nodes[child].end;
    }
    EXPECT_EQ(at, node.end);
  }
  EXPECT_EQ(oversized, tree.oversizedLeaves);
}

TEST(Octree, PartsTheTrianglesAtEveryNode) {
  for (const std::uint32_t limit : {1u, 16u, 300u, 1'000'000u}) {
    WeldedMesh mesh = computeWeldedMesh(testing::nastySoup(limit));
    expectSound(computeOctree(mesh, limit), mesh, limit);
  }
}

TEST(Octree, EndsWhereCentroidsCoincide) {
  TriangleMesh mesh = testing::bumpySphere(20);
  for (int i = 0; i < 100; ++i) mesh.triangles.push_back(mesh.triangles[17]);
  mesh.objects.resize(mesh.triangles.size(), 0);
  WeldedMesh welded = computeWeldedMesh(mesh);
  const Octree tree = computeOctree(welded, 16);
  expectSound(tree, welded, 16);
  EXPECT_EQ(tree.oversizedLeaves, 1u);
}

}  // namespace
}  // namespace hlodbench
