#include <gtest/gtest.h>

#include <filesystem>

#include "hlod/build/hierarchy_builder.h"
#include "mesh_helpers.h"

namespace hlodbench {
namespace {

// Forgets geometry.
class NoSink final : public NodeSink {
 public:
  void addGeometry(NodeId, std::span<const Vertex>, std::span<const std::uint32_t>) override {}
};

BuiltTree build(const TriangleMesh& mesh, std::uint64_t chunkTriangles = 300) {
  BuildOptions options;
  options.maxTriangles = 100;
  options.exactTriangles = 300;
  options.chunkTriangles = chunkTriangles;
  NoSink sink;
  BuildReport report;
  return buildTree(MeshTriangles(mesh), options, sink, report);
}

std::size_t consistentNodes(const TriangleMesh& mesh) {
  const BuiltTree tree = build(mesh);
  return static_cast<std::size_t>(
      std::count_if(tree.nodes.begin(), tree.nodes.end(),
                    [](const BuiltNode& node) { return node.consistentWinding; }));
}

// A band of `length` squares, the last joined to the first, once turned over.
TriangleMesh moebiusStrip(std::uint32_t length) {
  TriangleMesh mesh;
  mesh.objectTable.resize(1);
  for (std::uint32_t i = 0; i < length; ++i) {
    const double a = 2.0 * std::acos(-1.0) * i / length;
    for (const double side : {-0.3, 0.3})
      mesh.positions.emplace_back((1 + side * std::cos(a / 2)) * std::cos(a),
                                  (1 + side * std::cos(a / 2)) * std::sin(a),
                                  side * std::sin(a / 2));
  }
  for (std::uint32_t i = 0; i < length; ++i) {
    const bool last = i + 1 == length;
    const std::uint32_t a = 2 * i, b = 2 * i + 1;
    const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(b, d, c);
  }
  mesh.objects.resize(mesh.triangles.size(), 0);
  return mesh;
}

TEST(Winding, OfAClosedBodyIsConsistentInEveryNode) {
  const TriangleMesh mesh = testing::bumpySphere(60);
  EXPECT_EQ(consistentNodes(mesh), build(mesh).nodes.size());
}

TEST(Winding, OfAMoebiusStripOrASoupIsNot) {
  EXPECT_EQ(consistentNodes(moebiusStrip(1000)), 0u);
  EXPECT_EQ(consistentNodes(testing::nastySoup(2)), 0u);
}

// Wherever the one bad face lies: the edges within a chunk and between chunks are found. Of the
// faces of this step two show by edges between chunks only.
TEST(Winding, OneTurnedOrRepeatedFaceSpoilsItsObject) {
  const TriangleMesh good = testing::bumpySphere(40);
  for (std::size_t i = 0; i < good.triangles.size(); i += 172) {
    TriangleMesh mesh = good;
    std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
    EXPECT_EQ(consistentNodes(mesh), 0u) << i;
    mesh = good;
    const auto v = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(mesh.positions[mesh.triangles[i].z] * 1.01f);
    mesh.triangles.emplace_back(mesh.triangles[i].x, mesh.triangles[i].y, v);
    mesh.objects.push_back(0);
    EXPECT_EQ(consistentNodes(mesh), 0u) << i;
  }
}

TEST(Winding, OfOneObjectDoesNotSpoilNodesOfAnother) {
  TriangleMesh mesh = testing::bumpySphere(60);
  testing::addBumpySphere(mesh, 40, glm::vec3(40.0f, -1.0f, 2.0f), 1.5f, 1);
  std::swap(mesh.triangles.back().y, mesh.triangles.back().z);
  const BuiltTree tree = build(mesh);
  for (const BuiltNode& node : tree.nodes) {
    const bool hasBad = node.box.max.x > 30.0f;
    EXPECT_EQ(node.consistentWinding, !hasBad);
  }
}

}  // namespace
}  // namespace hlodbench
