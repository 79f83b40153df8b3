#include <gtest/gtest.h>

#include <set>

#include "hlod/build/manifold_parts.h"
#include "hlod/build/simplifier.h"
#include "hlod/core/error.h"
#include "mesh_helpers.h"

namespace hlodbench {
namespace {

SimplifierInput inputOf(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                        std::span<const std::uint8_t> locked, std::size_t target) {
  return {positions, triangles, locked, {}, target};
}

std::set<std::uint32_t> verticesOf(const std::vector<glm::uvec3>& triangles) {
  std::set<std::uint32_t> out;
  for (const glm::uvec3& t : triangles) out.insert({t.x, t.y, t.z});
  return out;
}

TEST(CreateSimplifier, ListsTheKnownNames) {
  try {
    createSimplifier("magic");
    FAIL();
  } catch (const InputError& error) {
    for (const std::string& name : simplifierNames()) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
      EXPECT_NE(createSimplifier(name), nullptr);
    }
  }
}

TEST(RemoveUselessTriangles, CountsWhatItLeavesOut) {
  const std::vector<glm::uvec3> triangles{{0, 1, 2}, {1, 2, 0}, {2, 1, 0}, {0, 1, 1}, {0, 1, 3}};
  SimplifierStats stats;
  EXPECT_EQ(removeUselessTriangles(inputOf({}, triangles, {}, 0), stats).size(), 2u);
  EXPECT_EQ(stats.duplicateTriangles, 2u);
  EXPECT_EQ(stats.degenerateTriangles, 1u);
}

TEST(RemoveUselessTriangles, RemovesPocketsBetweenLodsWithBothSides) {
  const std::vector<glm::uvec3> triangles{{0, 1, 2}, {4, 5, 6}, {2, 1, 0}, {6, 5, 4}, {0, 1, 3}};
  const std::vector<std::uint8_t> origins{kNotOriginal, 2, 3, 2, kNotOriginal};
  SimplifierInput input = inputOf({}, triangles, {}, 0);
  input.origins = origins;
  SimplifierStats stats;
  const std::vector<glm::uvec3> kept = removeUselessTriangles(input, stats);
  EXPECT_EQ(kept, (std::vector<glm::uvec3>{{4, 5, 6}, {0, 1, 3}}));
  EXPECT_EQ(stats.duplicateTriangles, 3u);
}

TEST(ManifoldParts, LosesNoTriangleAndMakesEveryEdgeFit) {
  const TriangleMesh soup = testing::nastySoup(11);
  SimplifierStats stats;
  const auto triangles = removeUselessTriangles(inputOf({}, soup.triangles, {}, 0), stats);
  const ManifoldParts parts = computeManifoldParts(triangles);
  ASSERT_EQ(parts.triangles.size(), triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    glm::uvec3 t = parts.triangles[i];
    if (parts.flipped[i] != 0) std::swap(t.y, t.z);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(parts.source[t[k]], triangles[i][k]);
  }
}

TEST(ManifoldParts, TurnsMixedWindingIntoOneClosedSurface) {
  TriangleMesh mesh = testing::bumpySphere(30);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
  const ManifoldParts parts = computeManifoldParts(mesh.triangles);
  EXPECT_EQ(parts.source.size(), mesh.positions.size());
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const glm::uvec3& t : parts.triangles)
    for (int k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
  for (const auto& [a, b] : edges) {
    EXPECT_EQ(edges.count({a, b}), 1u);
    EXPECT_EQ(edges.count({b, a}), 1u);
  }
}

class EverySimplifier : public ::testing::TestWithParam<std::string> {};

TEST_P(EverySimplifier, MeetsTheTargetWithVerticesItWasGiven) {
  const TriangleMesh mesh = testing::bumpySphere(60);
  const std::vector<std::uint8_t> locked(mesh.positions.size(), 0);
  SimplifierStats stats;
  const auto simplifier = createSimplifier(GetParam());
  for (const std::size_t target : {6000u, 2000u, 300u}) {
    const auto out =
        simplifier->simplify(inputOf(mesh.positions, mesh.triangles, locked, target), stats);
    EXPECT_LE(out.size(), target);
    EXPECT_GE(out.size(), target * 9 / 10);
    for (const glm::uvec3& t : out) {
      EXPECT_TRUE(t.x != t.y && t.y != t.z && t.z != t.x);
      EXPECT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
    }
  }
}

TEST_P(EverySimplifier, KeepsLockedVerticesAndTheBorderBetweenThem) {
  TriangleMesh mesh = testing::bumpySphere(60);
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) { return mesh.positions[t.x].x > 3.3f; });
  // Its border is locked, and some vertices in the middle, as where a neighbour touches a point.
  std::vector<std::uint8_t> locked(mesh.positions.size(), 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++edges[std::minmax({t[k], t[(k + 1) % 3]})];
  std::set<std::pair<std::uint32_t, std::uint32_t>> border;
  for (const auto& [edge, uses] : edges)
    if (uses == 1) {
      border.insert(edge);
      locked[edge.first] = locked[edge.second] = 1;
    }
  for (const glm::uvec3& t : mesh.triangles)
    if (t.x % 97 == 0) locked[t.x] = 1;
  ASSERT_GT(border.size(), 50u);
  SimplifierStats stats;
  const auto out = createSimplifier(GetParam())
                       ->simplify(inputOf(mesh.positions, mesh.triangles, locked, 400), stats);
  EXPECT_LT(out.size(), mesh.triangles.size() / 4);
  EXPECT_EQ(stats.fallbacks, 0u);
  const auto before = verticesOf(mesh.triangles);
  const auto after = verticesOf(out);
  for (const std::uint32_t v : before) EXPECT_TRUE(locked[v] == 0 || after.contains(v)) << v;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edgesAfter;
  for (const glm::uvec3& t : out)
    for (int k = 0; k < 3; ++k) ++edgesAfter[std::minmax({t[k], t[(k + 1) % 3]})];
  for (const auto& edge : border) EXPECT_EQ(edgesAfter[edge] % 2, 1);
}

TEST_P(EverySimplifier, TakesAnySoup) {
  const TriangleMesh soup = testing::nastySoup(21);
  const std::vector<std::uint8_t> locked(soup.positions.size(), 0);
  SimplifierStats stats;
  const auto out = createSimplifier(GetParam())
                       ->simplify(inputOf(soup.positions, soup.triangles, locked, 500), stats);
  EXPECT_FALSE(out.empty());
  EXPECT_LT(out.size(), soup.triangles.size() / 2);
  EXPECT_EQ(stats.degenerateTriangles, 301u);
  EXPECT_GE(stats.duplicateTriangles, 600u);
}

TEST_P(EverySimplifier, KeepsTheExtentOfAFlatSheet) {
  TriangleMesh mesh;
  constexpr int kSide = 30;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x) mesh.positions.emplace_back(x / 15.0f - 1, y / 15.0f - 1, 0);
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t v = y * (kSide + 1) + x;
      mesh.triangles.emplace_back(v, v + 1, v + kSide + 1);
      mesh.triangles.emplace_back(v + 1, v + kSide + 2, v + kSide + 1);
    }
  const std::vector<std::uint8_t> locked(mesh.positions.size(), 0);
  SimplifierStats stats;
  const auto out = createSimplifier("openmesh")
                       ->simplify(inputOf(mesh.positions, mesh.triangles, locked, 2), stats);
  double area = 0.0;
  for (const glm::uvec3& t : out)
    area += 0.5 * glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                         mesh.positions[t.z] - mesh.positions[t.x]));
  EXPECT_NEAR(area, 4.0, 1e-3);
  EXPECT_LE(out.size(), 8u);
}

// Half-edge collapses alone keep every body, and so at least 4 faces of each.
TEST_P(EverySimplifier, MeetsTheTargetAmongManySmallBodies) {
  TriangleMesh mesh;
  for (int i = 0; i < 400; ++i)
    testing::addBumpySphere(mesh, 4, glm::vec3(i % 20, i / 20, 0) * 0.1f - 0.9f, 0.04f);
  std::vector<std::uint8_t> locked(mesh.positions.size(), 0);
  locked[123] = 1;
  SimplifierStats stats;
  const auto out = createSimplifier(GetParam())
                       ->simplify(inputOf(mesh.positions, mesh.triangles, locked, 1000), stats);
  EXPECT_LE(out.size(), 1000u);
  EXPECT_GE(out.size(), 500u);  // a body that folds up loses 3 faces at once
  EXPECT_TRUE(verticesOf(out).contains(123));
}

INSTANTIATE_TEST_SUITE_P(All, EverySimplifier, ::testing::ValuesIn(simplifierNames()));

}  // namespace
}  // namespace hlodbench
