#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/core/error.h"
#include "mesh_helpers.h"

namespace hlodbench {
namespace {

using testing::Triangle;

// Chunks so small that every kind of node has some above them and below.
BuildOptions tinyChunks(const std::string& simplifier = "openmesh") {
  BuildOptions options;
  options.maxTriangles = 100;
  options.simplifier = simplifier;
  options.exactTriangles = 300;
  options.chunkTriangles = 300;
  return options;
}

BuildOptions oneChunk(BuildOptions options) {
  options.chunkTriangles = 1'000'000'000;
  return options;
}

TriangleMesh twoBodies() {
  TriangleMesh mesh = testing::bumpySphere(60);
  testing::addBumpySphere(mesh, 40, glm::vec3(4.0f, -1.0f, 2.0f), 1.5f, 1);
  return mesh;
}

void expectEqual(const Hierarchy& a, const Hierarchy& b) {
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    EXPECT_EQ(a.nodes[i].error, b.nodes[i].error) << i;
    EXPECT_EQ(a.nodes[i].box.min, b.nodes[i].box.min);
    EXPECT_EQ(a.nodes[i].box.max, b.nodes[i].box.max);
    EXPECT_EQ(a.nodes[i].firstChild, b.nodes[i].firstChild);
    EXPECT_EQ(a.nodes[i].childCount, b.nodes[i].childCount);
    ASSERT_EQ(a.nodes[i].indexCount, b.nodes[i].indexCount) << i;
  }
  EXPECT_TRUE(std::ranges::equal(a.geometry.bytes(), b.geometry.bytes()));
}

class ChunkedBuild : public ::testing::TestWithParam<std::string> {};

TEST_P(ChunkedBuild, MakesTheSameHierarchyAsOneChunk) {
  for (const TriangleMesh& mesh : {twoBodies(), testing::nastySoup(4)}) {
    BuildReport report;
    const Hierarchy chunked = buildHierarchy(mesh, tinyChunks(GetParam()), report);
    EXPECT_GT(report.chunks, 20u);
    EXPECT_EQ(validate(chunked), "");
    const Hierarchy whole = buildHierarchy(mesh, oneChunk(tinyChunks(GetParam())), report);
    EXPECT_EQ(report.chunks, 1u);
    expectEqual(chunked, whole);
  }
}

TEST_P(ChunkedBuild, DoesNotDependOnThreadsNorOnTheOrderOfTriangles) {
  TriangleMesh mesh = testing::nastySoup(5);
  BuildReport report;
  BuildOptions options = tinyChunks(GetParam());
  options.threads = 1;
  const Hierarchy one = buildHierarchy(mesh, options, report);
  std::vector<std::size_t> order(mesh.triangles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(9));
  TriangleMesh shuffled = mesh;
  for (std::size_t i = 0; i < order.size(); ++i) {
    shuffled.triangles[i] = mesh.triangles[order[i]];
    shuffled.objects[i] = mesh.objects[order[i]];
  }
  options.threads = 3;
  expectEqual(one, buildHierarchy(shuffled, options, report));
}

TEST_P(ChunkedBuild, AnyFrontOfAClosedBodyIsWatertight) {
  BuildReport report;
  const Hierarchy h = buildHierarchy(twoBodies(), tinyChunks(GetParam()), report);
  std::mt19937 random(7);
  for (int front = 0; front < 40; ++front) {
    const unsigned refine = 30 + random() % 70;
    const std::vector<Triangle> triangles = testing::randomFront(h, refine, random);
    EXPECT_EQ(testing::borderOf(triangles).size(), 0u) << "front " << front;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ChunkedBuild, ::testing::ValuesIn(simplifierNames()));

// One far triangle, so that all others lie in a small cell of a coarse grid.
TEST(ChunkPlan, CutsCrowdedCells) {
  TriangleMesh mesh = twoBodies();
  const auto v = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{9e4f, 0, 0}, {9e4f, 1, 0}, {9e4f, 0, 1}});
  mesh.triangles.emplace_back(v, v + 1, v + 2);
  mesh.objects.push_back(0);
  BuildReport report;
  const Hierarchy chunked = buildHierarchy(mesh, tinyChunks(), report);
  EXPECT_GT(report.chunks, 20u);
  expectEqual(chunked, buildHierarchy(mesh, oneChunk(tinyChunks()), report));
}

}  // namespace
}  // namespace hlodbench
