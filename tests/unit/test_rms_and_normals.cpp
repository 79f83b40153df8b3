// The error measure and the normals of --preset best.
#include <gtest/gtest.h>

#include <cmath>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/build/surface_points.h"
#include "hlod/tree/octahedral.h"
#include "mesh_helpers.h"

namespace hlodbench {
namespace {

BuildOptions best(ErrorMeasure error, LodNormals normals) {
  BuildOptions options;
  options.maxTriangles = 200;
  options.error = error;
  options.normals = normals;
  options.exactTriangles = 600;
  return options;
}

Hierarchy build(const TriangleMesh& mesh, const BuildOptions& options) {
  BuildReport report;
  return buildHierarchy(mesh, options, report);
}

TEST(RmsError, IsAtMostTheLargestAndGrowsTowardsTheRoot) {
  const TriangleMesh mesh = testing::bumpySphere(60);
  const Hierarchy largest = build(mesh, best(ErrorMeasure::kLargest, LodNormals::kOriginal));
  const Hierarchy rms = build(mesh, best(ErrorMeasure::kRms, LodNormals::kOriginal));
  EXPECT_EQ(validate(rms), "");
  ASSERT_EQ(rms.nodes.size(), largest.nodes.size());
  for (NodeId id = 0; id < rms.nodes.size(); ++id) {
    if (rms.node(id).isLeaf()) continue;
    EXPECT_GT(rms.node(id).error, 0.0f) << id;
    EXPECT_LT(rms.node(id).error, largest.node(id).error) << id;
  }
}

TEST(RmsError, OfAPlaneBesideAnotherIsTheirDistance) {
  WeldedMesh mesh;
  mesh.positions = {{0, 0, 0},       {1, 0, 0},      {0, 1, 0},
                    {-9, -9, 0.25f}, {9, -9, 0.25f}, {0, 9, 0.25f}};
  const std::vector<glm::uvec3> original{{0, 1, 2}};
  const std::vector<glm::uvec3> lod{{3, 4, 5}};
  Aabb box;
  for (const glm::vec3& p : mesh.positions) box.extend(p);
  const SurfaceSamples samples = takeSamples(mesh, original, 1000);
  EXPECT_NEAR(computeRmsError({mesh, lod, box, 0.0f}, samples), 0.25f, 1e-5f);
  EXPECT_EQ(computeRmsError({mesh, lod, box, 3.0f}, samples), 3.0f) << "never below the children's";
}

// The largest angle between a node's normals and those of the original surface, degrees.
double largestTurn(const Hierarchy& h, const Node& node, const Hierarchy& original) {
  double largest = 0.0;
  for (std::size_t v = 0; v < node.vertexCount; ++v) {
    const Vertex& a = h.vertices(node)[v];
    const Vertex& b = original.vertices(node)[v];
    EXPECT_EQ(a.position, b.position);
    const glm::vec3 na = decodeOctahedral({a.normal[0], a.normal[1]});
    const glm::vec3 nb = decodeOctahedral({b.normal[0], b.normal[1]});
    largest = std::max(largest, glm::degrees(std::acos(std::min(1.0, double(glm::dot(na, nb))))));
  }
  return largest;
}

TEST(SmoothedNormals, ChangeInnerNodesOnlyAndNeverTurnAround) {
  const TriangleMesh mesh = testing::bumpySphere(60);
  const Hierarchy plain = build(mesh, best(ErrorMeasure::kLargest, LodNormals::kOriginal));
  const Hierarchy smoothed = build(mesh, best(ErrorMeasure::kLargest, LodNormals::kSmoothed));
  ASSERT_EQ(plain.nodes.size(), smoothed.nodes.size());
  for (NodeId id = 0; id < plain.nodes.size(); ++id) {
    const Node& node = smoothed.node(id);
    ASSERT_EQ(node.vertexCount, plain.node(id).vertexCount);
    const double turn = largestTurn(smoothed, node, plain);
    if (node.isLeaf())
      EXPECT_LT(turn, 0.1) << id;  // what acos makes of rounding
    else
      EXPECT_LE(turn, 91.0) << id;
  }
  EXPECT_GT(largestTurn(smoothed, smoothed.node(kRoot), plain), 1.0);
}

TEST(SmoothedNormals, LeaveLockedVerticesAlone) {
  WeldedMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, glm::normalize(glm::vec3(1.0f, 0.0f, 1.0f)));
  mesh.objects.assign(3, 0);
  mesh.lockFirst = {0, 0, 0};
  mesh.lockLast = {0, 5, 0};  // the second is touched from outside
  OctreeNode node;
  node.begin = 0;
  node.end = 1;
  LocalIndex local;
  for (const std::uint32_t v : {0u, 1u, 2u}) local.add(v);
  const std::vector<glm::uvec3> triangles{{0, 1, 2}};
  const std::vector<glm::vec3> normals = computeSmoothedNormals(mesh, triangles, node, local);
  EXPECT_EQ(normals[0], glm::vec3(0.0f, 0.0f, 1.0f));
  EXPECT_EQ(normals[1], mesh.normals[1]);
}

}  // namespace
}  // namespace hlodbench
