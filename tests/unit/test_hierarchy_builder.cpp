#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/build/surface_distance.h"
#include "hlod/core/error.h"
#include "hlod/core/parallel_for.h"
#include "mesh_helpers.h"

namespace hlodbench {
namespace {

using testing::Triangle;

BuildOptions smallNodes(std::uint32_t maxTriangles, const std::string& simplifier = "openmesh") {
  BuildOptions options;
  options.maxTriangles = maxTriangles;
  options.simplifier = simplifier;
  return options;
}

std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) t = testing::canonical(t);
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

class BuildWith : public ::testing::TestWithParam<std::string> {};

TEST_P(BuildWith, EveryInputTriangleIsInExactlyOneLeaf) {
  const TriangleMesh mesh = testing::nastySoup(1);
  BuildReport report;
  const Hierarchy h = buildHierarchy(mesh, smallNodes(100, GetParam()), report);
  EXPECT_EQ(validate(h), "");
  std::vector<Triangle> in, out;
  for (const glm::uvec3& t : mesh.triangles)
    in.push_back({testing::toPoint(mesh.positions[t.x]), testing::toPoint(mesh.positions[t.y]),
                  testing::toPoint(mesh.positions[t.z])});
  for (const Node& node : h.nodes)
    if (node.isLeaf())
      for (const Triangle& t : testing::trianglesOf(h, node)) out.push_back(t);
  EXPECT_EQ(sorted(in), sorted(out));
  EXPECT_EQ(report.nodes, h.nodes.size());
  EXPECT_GT(report.leaves, 20u);
  EXPECT_GT(report.simplifier.degenerateTriangles, 0u);
  EXPECT_GT(report.simplifier.duplicateTriangles, 0u);
}

// Every front of the tree of a closed body is closed: nodes of different levels meet exactly.
TEST_P(BuildWith, AnyFrontOfAClosedBodyIsWatertight) {
  TriangleMesh mesh = testing::bumpySphere(100);
  testing::addBumpySphere(mesh, 60, glm::vec3(5.0f, -1.0f, 1.0f), 1.0f, 1);
  BuildReport report;
  const Hierarchy h = buildHierarchy(mesh, smallNodes(120, GetParam()), report);
  ASSERT_EQ(validate(h), "");
  ASSERT_GE(report.levels, 4u);
  EXPECT_EQ(report.simplifier.fallbacks, 0u);
  std::mt19937 random(7);
  for (int front = 0; front < 40; ++front) {
    const unsigned refine = 30 + random() % 70;
    const std::vector<Triangle> triangles = testing::randomFront(h, refine, random);
    EXPECT_EQ(testing::borderOf(triangles).size(), 0u) << "front " << front;
  }
}

// Shares of the samples that lie further from the node's LOD than its error says.
struct Excess {
  double vertices = 0.0;
  double faces = 0.0;
};

Excess measureExcess(const Hierarchy& h, NodeId id, std::mt19937& random) {
  const Node& node = h.node(id);
  const glm::vec3 centre = (node.box.min + node.box.max) * 0.5f;
  std::vector<glm::vec3> lod;
  for (std::uint32_t i = 0; i < node.indexCount; ++i)
    lod.push_back(testing::corner(h, node, i) - centre);
  const SurfaceDistance surface(lod);
  std::vector<glm::vec3> original;
  std::vector<double> areas;
  for (const NodeId leaf : testing::leavesUnder(h, id))
    for (std::uint32_t i = 0; i < h.node(leaf).indexCount; ++i)
      original.push_back(testing::corner(h, h.node(leaf), i) - centre);
  for (std::size_t t = 0; t < original.size(); t += 3)
    areas.push_back(
        glm::length(glm::cross(original[t + 1] - original[t], original[t + 2] - original[t])));
  std::discrete_distribution<std::size_t> face(areas.begin(), areas.end());
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::uint32_t hint = 0;
  const auto outside = [&](const glm::vec3& p) {
    return std::sqrt(surface.distanceSquared(p, -1.0f, hint)) > node.error ? 1 : 0;
  };
  constexpr int kSamples = 20000;
  int vertices = 0;
  int faces = 0;
  for (int i = 0; i < kSamples; ++i) {
    vertices += outside(original[random() % original.size()]);
    const std::size_t t = face(random) * 3;
    float u = unit(random);
    float v = unit(random);
    if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
    faces += outside(original[t] + (original[t + 1] - original[t]) * u +
                     (original[t + 2] - original[t]) * v);
  }
  return {vertices / double(kSamples), faces / double(kSamples)};
}

TEST_P(BuildWith, ErrorBoundsTheDistanceFromTheOriginal) {
  const TriangleMesh mesh = testing::bumpySphere(224);  // 99,904 triangles
  BuildReport report;
  const Hierarchy h = buildHierarchy(mesh, smallNodes(500, GetParam()), report);
  ASSERT_EQ(validate(h), "");
  ASSERT_GE(report.levels, 4u);
  std::mt19937 random(2024);
  double sum = 0.0;
  int nodes = 0;
  for (NodeId id = 0; id < h.nodes.size(); ++id) {
    if (h.node(id).isLeaf()) continue;
    if (h.node(id).level > 1 && id % 4 != 0) continue;
    const Excess excess = measureExcess(h, id, random);
    EXPECT_LE(excess.vertices, 0.001) << "node " << id;
    EXPECT_LE(excess.faces, 0.001) << "node " << id;
    sum += excess.vertices + excess.faces;
    ++nodes;
  }
  EXPECT_LE(sum / (2 * nodes), 1e-4);
  // And it is no lazy bound: the root's LOD is a fair likeness of the body.
  EXPECT_LT(h.node(kRoot).error, 0.03f * h.node(kRoot).box.diagonal());
}

TEST_P(BuildWith, TheNumberOfThreadsDoesNotChangeAByte) {
  const TriangleMesh mesh = testing::nastySoup(5);
  BuildReport report;
  BuildOptions options = smallNodes(60, GetParam());
  options.threads = 1;
  const Hierarchy one = buildHierarchy(mesh, options, report);
  options.threads = 3;
  const Hierarchy three = buildHierarchy(mesh, options, report);
  ASSERT_EQ(one.nodes.size(), three.nodes.size());
  const auto a = one.geometry.bytes();
  const auto b = three.geometry.bytes();
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  for (std::size_t i = 0; i < one.nodes.size(); ++i)
    EXPECT_EQ(one.nodes[i].error, three.nodes[i].error);
}

INSTANTIATE_TEST_SUITE_P(All, BuildWith, ::testing::ValuesIn(simplifierNames()));

TEST(BuildHierarchy, AMeshBelowTheLimitIsOneLeaf) {
  BuildReport report;
  const Hierarchy h = buildHierarchy(testing::bumpySphere(10), BuildOptions(), report);
  EXPECT_EQ(validate(h), "");
  EXPECT_EQ(h.nodes.size(), 1u);
  EXPECT_EQ(h.node(kRoot).error, 0.0f);
}

TEST(BuildHierarchy, DegenerateTrianglesAloneInANodeDoNoHarm) {
  TriangleMesh mesh = testing::bumpySphere(10);
  std::mt19937 random(3);
  for (std::uint32_t i = 0; i < 500; ++i) {
    mesh.positions.emplace_back(50.0f + float(random() % 1000) / 100.0f, i / 10.0f, 1.0f);
    const auto v = static_cast<std::uint32_t>(mesh.positions.size()) - 1;
    mesh.triangles.emplace_back(v, v, v);
  }
  mesh.objects.resize(mesh.triangles.size(), 0);
  BuildReport report;
  const Hierarchy h = buildHierarchy(mesh, smallNodes(20), report);
  EXPECT_EQ(validate(h), "");
  EXPECT_EQ(h.inputTriangles, mesh.triangles.size());
}

TEST(BuildHierarchy, RefusesBadOptions) {
  BuildReport report;
  const TriangleMesh mesh = testing::bumpySphere(10);
  EXPECT_THROW(buildHierarchy(mesh, smallNodes(3), report), InputError);
  EXPECT_THROW(buildHierarchy(mesh, smallNodes(100, "magic"), report), InputError);
}

TEST(BuildHierarchy, ReportsProgressThatNeverGoesBackInAStage) {
  BuildReport report;
  std::string stage;
  double last = 0.0;
  int calls = 0;
  buildHierarchy(testing::bumpySphere(60), smallNodes(100), report,
                 [&](const std::string& name, double share) {
                   EXPECT_TRUE(name != stage || share >= last);
                   EXPECT_LE(share, 1.0);
                   stage = name;
                   last = share;
                   ++calls;
                 });
  EXPECT_GT(calls, 4);
}

TEST(ParallelFor, VisitsEveryIndexOnceAndHandsOnExceptions) {
  std::vector<std::atomic<int>> visits(1000);
  parallelFor(visits.size(), 4, [&](std::size_t i, unsigned worker) {
    EXPECT_LT(worker, 4u);
    ++visits[i];
  });
  for (const auto& count : visits) EXPECT_EQ(count, 1);
  EXPECT_THROW(parallelFor(100, 3,
                           [](std::size_t i, unsigned) {
                             if (i == 50) throw InputError("stop");
                           }),
               InputError);
  parallelFor(0, 3, [](std::size_t, unsigned) { FAIL(); });
}

}  // namespace
}  // namespace hlodbench
