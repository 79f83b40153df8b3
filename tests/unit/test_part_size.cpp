#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/scene/part_size.h"
#include "mesh_helpers.h"

namespace hlodbench {
namespace {

using namespace hlodbench::testing;

double sizeOf(const TriangleMesh& mesh) {
  return computeMeanPartSize(mesh.positions, mesh.triangles);
}

TriangleMesh spheres(int count, int n) {
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i)
    addBumpySphere(mesh, n, glm::vec3(3.0f * static_cast<float>(i), 0.0f, 0.0f), 1.0f);
  return mesh;
}

// Every triangle with corners of its own, in random order: what an STL file holds.
TriangleMesh shatter(const TriangleMesh& mesh) {
  TriangleMesh out;
  out.objectTable = mesh.objectTable;
  out.objects = mesh.objects;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (int corner = 0; corner < 3; ++corner) out.positions.push_back(mesh.positions[t[corner]]);
    out.triangles.emplace_back(first, first + 1, first + 2);
  }
  std::mt19937 random(1);
  std::shuffle(out.triangles.begin(), out.triangles.end(), random);
  return out;
}

TEST(PartSize, IsTheMeanOverConnectedParts) {
  const double one = static_cast<double>(spheres(1, 20).triangles.size());
  EXPECT_EQ(sizeOf(spheres(1, 20)), one);
  EXPECT_EQ(sizeOf(spheres(7, 20)), one);
  TriangleMesh mixed = spheres(1, 20);
  addBumpySphere(mixed, 40, glm::vec3(9.0f), 1.0f);
  EXPECT_EQ(sizeOf(mixed), static_cast<double>(mixed.triangles.size()) / 2.0);
  EXPECT_EQ(sizeOf(TriangleMesh()), 0.0);
}

TEST(PartSize, CountsEqualPlacesAsConnected) {
  const TriangleMesh whole = spheres(5, 12);
  EXPECT_EQ(sizeOf(shatter(whole)), sizeOf(whole));
}

TEST(PartSize, DecidesHowLargeNodesAreWhereThatIsAskedFor) {
  BuildOptions options;
  options.maxTriangles = 16000;
  options.adaptToParts = true;
  const auto build = [&](const TriangleMesh& mesh, BuildReport& report) {
    return buildHierarchy(mesh, options, report);
  };
  BuildReport small, large, asGiven;
  const Hierarchy ofSmall = build(spheres(20, 24), small);  // 1104 triangles each
  EXPECT_EQ(small.smallPartSize, 1104.0);
  EXPECT_GT(ofSmall.nodes.size(), 10u);
  EXPECT_LE(small.largestNode, 2u * kSmallPart);
  build(spheres(1, 80), large);
  EXPECT_EQ(large.smallPartSize, 0.0);
  EXPECT_GT(large.largestNode, 2u * kSmallPart);
  options.adaptToParts = false;
  build(spheres(20, 24), asGiven);
  EXPECT_EQ(asGiven.smallPartSize, 0.0);
  EXPECT_GT(asGiven.largestNode, 2u * kSmallPart);
}

}  // namespace
}  // namespace hlodbench
