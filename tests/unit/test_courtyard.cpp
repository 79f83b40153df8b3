#include "hlod/scene/courtyard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "hlod/core/aabb.h"
#include "hlod/core/error.h"

namespace hlodbench {
namespace {

// Small enough to be quick, large enough for every body to show its shape.
constexpr std::uint32_t kSmall = 200'000;

const TriangleMesh& getSmallScene() {
  static const TriangleMesh mesh = generateCourtyard({1, kSmall});
  return mesh;
}

template <typename T>
bool haveSameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

struct DirectedEdge {
  std::uint32_t low, high, face;
  bool forward;
  auto operator<=>(const DirectedEdge&) const = default;
};

// Every edge of every triangle, equal edges next to each other.
std::vector<DirectedEdge> listEdges(const TriangleMesh& mesh) {
  std::vector<DirectedEdge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
    const glm::uvec3& t = mesh.triangles[face];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), face, a < b});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// The number of triangles around a vertex and of those reached by walking around it from one of
// them are the same exactly where the surface is a disc about the vertex.
std::size_t countPinchedVertices(const TriangleMesh& mesh) {
  // next[corner]: at vertex v of face (v, b, c), the face goes from edge v-b to edge v-c.
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> fans(mesh.positions.size());
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) fans[t[k]].emplace_back(t[(k + 1) % 3], t[(k + 2) % 3]);
  std::size_t pinched = 0;
  for (const auto& fan : fans) {
    if (fan.empty()) continue;
    std::size_t steps = 0;
    std::uint32_t at = fan.front().first;
    do {
      const auto it = std::find_if(fan.begin(), fan.end(), [at](auto& f) { return f.first == at; });
      if (it == fan.end()) break;
      at = it->second;
    } while (++steps < fan.size() && at != fan.front().first);
    if (steps != fan.size() || at != fan.front().first) ++pinched;
  }
  return pinched;
}

double computeArea(const TriangleMesh& mesh, const glm::uvec3& t) {
  const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

class CourtyardCount : public testing::TestWithParam<std::uint32_t> {};

TEST_P(CourtyardCount, IsWithinFivePercent) {
  const TriangleMesh mesh = generateCourtyard({1, GetParam()});
  EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), GetParam(), 0.05 * GetParam());
}

INSTANTIATE_TEST_SUITE_P(Sizes, CourtyardCount,
                         testing::Values(50'000u, 123'456u, 1'000'000u, 3'000'000u));

TEST(Courtyard, CountHoldsForOtherSeeds) {
  for (std::uint64_t seed = 2; seed < 8; ++seed) {
    const auto count = static_cast<double>(generateCourtyard({seed, 50'000}).triangles.size());
    EXPECT_NEAR(count, 50'000, 2'500) << "seed " << seed;
  }
}

TEST(Courtyard, SameSeedGivesSameBytes) {
  const TriangleMesh again = generateCourtyard({1, kSmall});
  const TriangleMesh& mesh = getSmallScene();
  EXPECT_TRUE(haveSameBytes(mesh.positions, again.positions));
  EXPECT_TRUE(haveSameBytes(mesh.triangles, again.triangles));
  EXPECT_TRUE(haveSameBytes(mesh.objects, again.objects));
  ASSERT_EQ(mesh.objectTable.size(), again.objectTable.size());
  for (std::size_t i = 0; i < mesh.objectTable.size(); ++i) {
    EXPECT_EQ(mesh.objectTable[i].name, again.objectTable[i].name);
    EXPECT_EQ(mesh.objectTable[i].color, again.objectTable[i].color);
  }
}

TEST(Courtyard, AnotherSeedGivesAnotherArrangement) {
  const TriangleMesh other = generateCourtyard({2, kSmall});
  EXPECT_FALSE(haveSameBytes(getSmallScene().positions, other.positions));
  std::vector<std::string> first, second;
  for (const SceneObject& object : getSmallScene().objectTable) first.push_back(object.name);
  for (const SceneObject& object : other.objectTable) second.push_back(object.name);
  EXPECT_NE(first, second);
}

TEST(Courtyard, IndicesAreConsistent) {
  const TriangleMesh& mesh = getSmallScene();
  ASSERT_EQ(mesh.objects.size(), mesh.triangles.size());
  EXPECT_GE(mesh.objectTable.size(), 60u);
  EXPECT_LE(mesh.objectTable.size(), 400u);
  constexpr std::uint32_t kUnused = ~0u;
  std::vector<std::uint32_t> owner(mesh.positions.size(), kUnused);
  std::vector<std::size_t> sizes(mesh.objectTable.size(), 0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    ASSERT_LT(mesh.objects[i], mesh.objectTable.size());
    ++sizes[mesh.objects[i]];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = mesh.triangles[i][k];
      ASSERT_LT(vertex, mesh.positions.size());
      if (owner[vertex] == kUnused) owner[vertex] = mesh.objects[i];
      ASSERT_EQ(owner[vertex], mesh.objects[i]) << "vertex of two objects";
    }
  }
  EXPECT_THAT(sizes, testing::Each(testing::Gt(0u)));
  EXPECT_THAT(owner, testing::Not(testing::Contains(kUnused)));
}

TEST(Courtyard, ObjectsAreNamedAndColored) {
  std::set<std::string> names;
  std::set<float> reds;
  for (const SceneObject& object : getSmallScene().objectTable) {
    EXPECT_TRUE(names.insert(object.name).second) << object.name << " is there twice";
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(object.color[k], 0.0f);
      EXPECT_LE(object.color[k], 1.0f);
    }
    reds.insert(object.color.r);
  }
  EXPECT_FALSE(names.contains(""));
  EXPECT_GT(reds.size(), 50u);
}

// Checked at the coarsest size too, where the lattices are smallest.
class CourtyardSurface : public testing::TestWithParam<std::uint32_t> {};

TEST_P(CourtyardSurface, EveryEdgeHasTwoOpposedFaces) {
  const TriangleMesh mesh = generateCourtyard({3, GetParam()});
  const std::vector<DirectedEdge> edges = listEdges(mesh);
  ASSERT_EQ(edges.size() % 2, 0u);
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    const DirectedEdge &a = edges[i], &b = edges[i + 1];
    const std::string& name = mesh.objectTable[mesh.objects[a.face]].name;
    ASSERT_NE(a.low, a.high) << name;
    ASSERT_TRUE(a.low == b.low && a.high == b.high) << "border edge in " << name;
    ASSERT_NE(a.forward, b.forward) << "flipped face in " << name;
    if (i + 2 < edges.size()) {
      ASSERT_FALSE(edges[i + 2].low == a.low && edges[i + 2].high == a.high)
          << "edge of over two faces in " << name;
    }
  }
  EXPECT_EQ(countPinchedVertices(mesh), 0u);
}

TEST_P(CourtyardSurface, NoTriangleIsDegenerate) {
  const TriangleMesh mesh = generateCourtyard({3, GetParam()});
  for (const glm::vec3& p : mesh.positions) {
    ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    ASSERT_GT(computeArea(mesh, mesh.triangles[i]), 1e-8)
        << "in " << mesh.objectTable[mesh.objects[i]].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, CourtyardSurface, testing::Values(50'000u, 1'000'000u));

TEST(Courtyard, EveryBodyEnclosesPositiveVolume) {
  const TriangleMesh& mesh = getSmallScene();
  // Bodies by their connected parts: an object's total would hide a small body turned inside out.
  std::vector<std::uint32_t> parent(mesh.positions.size());
  for (std::uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto find = [&parent](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const glm::uvec3& t : mesh.triangles) {
    parent[find(t.y)] = find(t.x);
    parent[find(t.z)] = find(t.x);
  }
  std::vector<double> volumes(mesh.positions.size(), 0.0);
  std::vector<std::uint32_t> object(mesh.positions.size(), 0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    const std::uint32_t body = find(t.x);
    // Measured from a vertex of the body, so that a far origin costs no digits.
    const glm::dvec3 o = mesh.positions[body];
    const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    volumes[body] += glm::dot(a - o, glm::cross(b - o, c - o)) / 6.0;
    object[body] = mesh.objects[i];
  }
  for (std::uint32_t v = 0; v < parent.size(); ++v) {
    if (find(v) != v) continue;
    EXPECT_GT(volumes[v], 1e-5) << mesh.objectTable[object[v]].name;
  }
}

TEST(Courtyard, BoxIsThatOfACourtyard) {
  Aabb box;
  for (const glm::vec3& p : getSmallScene().positions) box.extend(p);
  EXPECT_GT(box.max.x - box.min.x, 28.0f);
  EXPECT_LT(box.max.x - box.min.x, 40.0f);
  EXPECT_GT(box.max.z - box.min.z, 28.0f);
  EXPECT_LT(box.max.z - box.min.z, 42.0f);
  EXPECT_GT(box.max.y, 4.0f);
  EXPECT_LT(box.max.y, 8.0f);
  EXPECT_GT(box.min.y, -1.0f);
  EXPECT_LT(box.min.y, 0.0f);
}

TEST(Courtyard, RefusesSizesOutOfRange) {
  EXPECT_THROW(generateCourtyard({1, 49'999}), InputError);
  EXPECT_THROW(generateCourtyard({1, 20'000'001}), InputError);
  EXPECT_THROW(generateCourtyard({1, 0}), InputError);
  try {
    generateCourtyard({1, 7});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("50000 to 20000000, found 7"));
  }
}

}  // namespace
}  // namespace hlodbench
