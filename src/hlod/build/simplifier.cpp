#include "hlod/build/simplifier.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>

#include "hlod/build/meshopt_simplifier.h"
#include "hlod/build/openmesh_simplifier.h"
#include "hlod/core/error.h"

namespace hlodbench {

void SimplifierStats::add(const SimplifierStats& other) {
  splitVertices += other.splitVertices;
  flippedFaces += other.flippedFaces;
  degenerateTriangles += other.degenerateTriangles;
  duplicateTriangles += other.duplicateTriangles;
  foldedFaces += other.foldedFaces;
  fallbacks += other.fallbacks;
}

std::vector<std::string> simplifierNames() {
  std::vector<std::string> names{"openmesh"};
  if (kHaveMeshoptimizer) names.emplace_back("meshopt");
  return names;
}

std::unique_ptr<Simplifier> createSimplifier(std::string_view name) {
  if (name == "openmesh") return createOpenMeshSimplifier();
  if (name == "meshopt" && kHaveMeshoptimizer) return createMeshoptSimplifier();
  throw InputError(fmt::format("simplifier: expected one of {}, found \"{}\"",
                               fmt::join(simplifierNames(), ", "), name));
}

namespace {

bool isDegenerate(const glm::uvec3& t) {
  return t.x == t.y || t.y == t.z || t.z == t.x;
}

// The triangle's corners in increasing order: equal for triangles of the same corners.
glm::uvec3 sortedCorners(const glm::uvec3& t) {
  const std::uint32_t low = std::min({t.x, t.y, t.z});
  const std::uint32_t high = std::max({t.x, t.y, t.z});
  return {low, t.x + t.y + t.z - low - high, high};
}

// Whether the corners run the way sortedCorners() gives them, up to rotation.
bool isEven(const glm::uvec3& t) {
  return (t.x < t.y && t.y < t.z) || (t.y < t.z && t.z < t.x) || (t.z < t.x && t.x < t.y);
}

std::uint64_t hashCorners(const glm::uvec3& key) {
  std::uint64_t hash = key.x * 0x9e3779b97f4a7c15u + key.y;
  hash = (hash ^ (hash >> 29)) * 0xbf58476d1ce4e5b9u + key.z;
  return hash ^ (hash >> 31);
}

}  // namespace

std::vector<glm::uvec3> removeUselessTriangles(const SimplifierInput& input,
                                               SimplifierStats& stats) {
  constexpr std::uint32_t kEmpty = 0xffffffffu;
  const std::span<const glm::uvec3> triangles = input.triangles;
  std::vector<std::uint8_t> dropped(triangles.size(), 0);
  std::vector<std::uint32_t> slots(std::bit_ceil(triangles.size() * 2 + 2), kEmpty);
  const std::size_t mask = slots.size() - 1;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const glm::uvec3& t = triangles[i];
    if (isDegenerate(t)) {
      ++stats.degenerateTriangles;
      dropped[i] = 1;
      continue;
    }
    const glm::uvec3 key = sortedCorners(t);
    std::size_t slot = hashCorners(key) & mask;
    while (slots[slot] != kEmpty && sortedCorners(triangles[slots[slot]]) != key)
      slot = (slot + 1) & mask;
    const std::uint32_t first = slots[slot];
    if (first == kEmpty || dropped[first] != 0) {
      slots[slot] = i;
      continue;
    }
    ++stats.duplicateTriangles;
    dropped[i] = 1;
    const bool original = input.origins.empty() || (input.origins[i] != kNotOriginal &&
                                                    input.origins[i] == input.origins[first]);
    if (original || isEven(t) == isEven(triangles[first])) continue;
    ++stats.duplicateTriangles;
    dropped[first] = 1;
  }
  std::vector<glm::uvec3> kept;
  kept.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (dropped[i] == 0) kept.push_back(triangles[i]);
  return kept;
}

}  // namespace hlodbench
