#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/tree/geometry_packer.h"
#include "mesh_helpers.h"

namespace hlodbench {
namespace {

Hierarchy sphereTree() {
  BuildOptions options;
  options.maxTriangles = 200;
  BuildReport report;
  return buildHierarchy(testing::bumpySphere(60), options, report);
}

struct Damage {
  const char* name;
  std::function<void(Hierarchy&)> apply;
};

void PrintTo(const Damage& damage, std::ostream* out) {
  *out << damage.name;
}

Node& someLeaf(Hierarchy& h) {
  return h.nodes.back();
}

// Changes the root's vertices and indices, and its checksum with them.
template <typename Change>
void changeBlock(Hierarchy& h, Change change) {
  Node& node = h.nodes[kRoot];
  std::vector<Vertex> vertices(h.vertices(node).begin(), h.vertices(node).end());
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < h.indices(node).size(); ++i) indices.push_back(h.indices(node)[i]);
  change(vertices, indices);
  const std::uint64_t size = node.blockBytes();
  GeometryPacker packer;
  const auto block = packer.pack(vertices, indices, node);
  ASSERT_EQ(block.size(), size);
  std::vector<std::byte> all(h.geometry.bytes().begin(), h.geometry.bytes().end());
  std::copy(block.begin(), block.end(), all.begin() + node.geometryOffset);
  h.geometry = GeometrySection(std::move(all));
}

class Damaged : public ::testing::TestWithParam<Damage> {};

TEST_P(Damaged, IsReportedInOneLineWithTheNode) {
  Hierarchy h = sphereTree();
  ASSERT_EQ(validate(h), "");
  ASSERT_GT(h.nodes.size(), 10u);
  GetParam().apply(h);
  const std::string problem = validate(h);
  EXPECT_NE(problem, "");
  EXPECT_EQ(problem.find('\n'), std::string::npos);
  EXPECT_NE(problem.find("node"), std::string::npos) << problem;
}

INSTANTIATE_TEST_SUITE_P(
    All, Damaged,
    ::testing::Values(
        Damage{"no node", [](Hierarchy& h) { h.nodes.clear(); }},
        Damage{"second root", [](Hierarchy& h) { someLeaf(h).parent = kNoNode; }},
        Damage{"root with a parent", [](Hierarchy& h) { h.nodes[0].parent = 0; }},
        Damage{"parent after child", [](Hierarchy& h) { h.nodes[1].parent = 5; }},
        Damage{"wrong parent", [](Hierarchy& h) { someLeaf(h).parent = 0; }},
        Damage{"wrong level", [](Hierarchy& h) { ++someLeaf(h).level; }},
        Damage{"root level", [](Hierarchy& h) { h.nodes[0].level = 1; }},
        Damage{"nine children", [](Hierarchy& h) { h.nodes[0].childCount = 9; }},
        Damage{"children out of range", [](Hierarchy& h) { h.nodes[0].firstChild = 0xfffffff0u; }},
        Damage{"leaf with a first child", [](Hierarchy& h) { someLeaf(h).firstChild = 3; }},
        Damage{"one child too few", [](Hierarchy& h) { --h.nodes[0].childCount; }},
        Damage{"leaf error", [](Hierarchy& h) { someLeaf(h).error = 0.1f; }},
        Damage{"error that decreases", [](Hierarchy& h) { h.nodes[0].error = 0.0f; }},
        Damage{"negative error", [](Hierarchy& h) { h.nodes[0].error = -1.0f; }},
        Damage{"error that is no number", [](Hierarchy& h) { h.nodes[0].error = NAN; }},
        Damage{"box outside", [](Hierarchy& h) { h.nodes[3].box.max.x += 100.0f; }},
        Damage{"empty box", [](Hierarchy& h) { someLeaf(h).box = Aabb(); }},
        Damage{"box too small", [](Hierarchy& h) { someLeaf(h).box.max = someLeaf(h).box.min; }},
        Damage{"vertex that is no number",
               [](Hierarchy& h) {
                 changeBlock(h, [](auto& vertices, auto&) { vertices[0].position.y = NAN; });
               }},
        Damage{"vertex of no object",
               [](Hierarchy& h) {
                 changeBlock(h, [](auto& vertices, auto&) { vertices[1].object = 1; });
               }},
        Damage{"vertex of a neighbour",
               [](Hierarchy& h) {
                 changeBlock(h, [](auto& vertices, auto&) { vertices[2].position.x += 9.0f; });
               }},
        Damage{"index out of range", [](Hierarchy& h) { --someLeaf(h).vertexCount; }},
        Damage{"another checksum", [](Hierarchy& h) { ++someLeaf(h).geometryHash; }},
        Damage{"another block", [](Hierarchy& h) { someLeaf(h).geometryOffset -= 16; }},
        Damage{"block out of range", [](Hierarchy& h) { someLeaf(h).geometryOffset += 16; }},
        Damage{"block not aligned", [](Hierarchy& h) { someLeaf(h).geometryOffset -= 8; }},
        Damage{"huge block", [](Hierarchy& h) { someLeaf(h).indexCount = 0xfffffffcu; }},
        Damage{"huge offset", [](Hierarchy& h) { someLeaf(h).geometryOffset = ~0ull << 4; }},
        Damage{"half a triangle", [](Hierarchy& h) { --someLeaf(h).indexCount; }},
        Damage{"nothing to draw", [](Hierarchy& h) { h.nodes[0].indexCount = 0; }},
        Damage{"triangles lost", [](Hierarchy& h) { ++h.inputTriangles; }}));

}  // namespace
}  // namespace hlodbench
