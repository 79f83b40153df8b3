#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/build/octree.h"
#include "hlod/build/welded_mesh.h"
#include "hlod/core/error.h"
#include "mesh_helpers.h"

namespace hlodbench {
namespace {

std::vector<SceneTriangle> trianglesOf(const TriangleMesh& mesh) {
  std::vector<SceneTriangle> out(mesh.triangles.size());
  MeshTriangles(mesh).read(0, out);
  return out;
}

TEST(Weld, JoinsEqualPositionsOfOneObjectOnly) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, -0.0f}, {0, 1, 0}, {-1, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {0, 2, 5}};
  mesh.objects = {0, 0, 1};
  mesh.objectTable.resize(2);
  const WeldedMesh welded = computeWeldedMesh(trianglesOf(mesh), 1.0);
  EXPECT_EQ(welded.positions.size(), 4u + 3u);
  const std::uint32_t both = welded.triangles[0].x;
  EXPECT_EQ(both, welded.triangles[1].x);  // 0 and -0
  EXPECT_NE(both, welded.triangles[2].x);
  EXPECT_EQ(welded.positions[both], welded.positions[welded.triangles[2].x]);
  EXPECT_TRUE(welded.isLocked(both, 0, 3));  // where two objects meet
  const std::uint32_t alone = welded.triangles[0].y;
  EXPECT_FALSE(welded.isLocked(alone, 0, 3));
  EXPECT_FALSE(welded.isLocked(alone, 0, 1));
  EXPECT_TRUE(welded.isLocked(alone, 1, 3));
}

TEST(Weld, NormalsPointOutOfAClosedBodyAndAreUnitLength) {
  const TriangleMesh soup = testing::nastySoup(3);
  for (const glm::vec3& n : computeWeldedMesh(trianglesOf(soup), 0.25).normals)
    EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
  const WeldedMesh sphere = computeWeldedMesh(trianglesOf(testing::bumpySphere(60)), 0.25);
  for (std::size_t v = 0; v < sphere.positions.size(); ++v)
    EXPECT_GT(glm::dot(sphere.normals[v], sphere.positions[v] - glm::vec3(3, -2, 1)), 0.0f);
}

TEST(BuildHierarchy, RefusesBadMeshesWithOneLine) {
  const auto messageOf = [](auto&& spoil) {
    TriangleMesh mesh = testing::bumpySphere(10);
    spoil(mesh);
    try {
      BuildReport report;
      buildHierarchy(mesh, BuildOptions(), report);
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

// The codes of a scene's triangles, in order.
std::vector<std::uint64_t> codesOf(const TriangleMesh& mesh) {
  Aabb box;
  for (const SceneTriangle& t : trianglesOf(mesh))
    for (const glm::vec3& corner : t.corners) box.extend(corner);
  const CellCodes cells(box);
  std::vector<std::uint64_t> codes;
  for (const SceneTriangle& t : trianglesOf(mesh)) codes.push_back(cells.codeOf(t));
  std::sort(codes.begin(), codes.end());
  return codes;
}

// Returns the number of leaves over the limit.
int expectSound(const std::vector<OctreeNode>& nodes, std::size_t triangles, std::uint32_t limit) {
  EXPECT_EQ(nodes[0].begin, 0u);
  EXPECT_EQ(nodes[0].end, triangles);
  int oversized = 0;
  for (NodeId id = 0; id < nodes.size(); ++id) {
    const OctreeNode& node = nodes[id];
    EXPECT_GT(node.triangles, 0u);
    EXPECT_EQ(node.triangles, node.end - node.begin);
    if (node.isLeaf()) {
      oversized += node.triangles > limit ? 1 : 0;
      continue;
    }
    EXPECT_GT(node.triangles, limit);
    EXPECT_GE(node.childCount, 2u);
    EXPECT_LE(node.childCount, 8u);
    std::uint32_t at = node.begin;
    for (NodeId child = node.firstChild; child < node.firstChild + node.childCount; ++child) {
      EXPECT_EQ(nodes[child].level, node.level + 1);
      EXPECT_EQ(nodes[child].begin, at);
      at = nodes[child].end;
    }
    EXPECT_EQ(at, node.end);
  }
  return oversized;
}

TEST(Octree, PartsTheTrianglesAtEveryNode) {
  for (const std::uint32_t limit : {1u, 16u, 300u, 1'000'000u}) {
    const std::vector<std::uint64_t> codes = codesOf(testing::nastySoup(limit));
    expectSound(computeOctree(codes, limit), codes.size(), limit);
  }
}

// Bodies that stand on a plane are not cut through by the planes that part them from each other.
TEST(Octree, CutsAFlatSceneAcrossItsShortSideLast) {
  for (const int flat : {0, 1, 2}) {
    TriangleMesh mesh;
    std::uint32_t object = 0;
    for (int row = 0; row < 8; ++row)
      for (int column = 0; column < 8; ++column) {
        glm::vec3 centre(0.37f);
        centre[(flat + 1) % 3] = 3.0f * static_cast<float>(row);
        centre[(flat + 2) % 3] = 3.0f * static_cast<float>(column);
        testing::addBumpySphere(mesh, 12, centre, 1.0f, object++);
      }
    const std::uint32_t limit = static_cast<std::uint32_t>(mesh.triangles.size()) / 16;
    const std::vector<OctreeNode> nodes = computeOctree(codesOf(mesh), limit);
    EXPECT_GE(nodes.size(), 1u + 4u + 16u);
    for (const OctreeNode& node : nodes) EXPECT_LE(node.childCount, 4u) << "flat axis " << flat;
    // a body is cut through in the end
    const std::vector<OctreeNode> deep = computeOctree(codesOf(mesh), 20);
    EXPECT_TRUE(std::any_of(deep.begin(), deep.end(),
                            [](const OctreeNode& node) { return node.childCount > 4; }));
  }
}

TEST(Octree, EndsWhereCentroidsCoincide) {
  TriangleMesh mesh = testing::bumpySphere(20);
  for (int i = 0; i < 100; ++i) mesh.triangles.push_back(mesh.triangles[17]);
  mesh.objects.resize(mesh.triangles.size(), 0);
  const std::vector<std::uint64_t> codes = codesOf(mesh);
  EXPECT_EQ(expectSound(computeOctree(codes, 16), codes.size(), 16), 1);
}

}  // namespace
}  // namespace hlodbench
