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

std::vector<glm::uvec3> removeUselessTriangles(std::span<const glm::uvec3> triangles,
                                               SimplifierStats& stats) {
  constexpr std::uint32_t kEmpty = 0xffffffffu;
  std::vector<glm::uvec3> kept;
  std::vector<glm::uvec3> keys;  // of the kept ones, corners sorted
  kept.reserve(triangles.size());
  keys.reserve(triangles.size());
  std::vector<std::uint32_t> slots(std::bit_ceil(triangles.size() * 2 + 2), kEmpty);
  const std::size_t mask = slots.size() - 1;
  for (const glm::uvec3& t : triangles) {
    if (t.x == t.y || t.y == t.z || t.z == t.x) {
      ++stats.degenerateTriangles;
      continue;
    }
    const std::uint32_t low = std::min({t.x, t.y, t.z});
    const std::uint32_t high = std::max({t.x, t.y, t.z});
    const glm::uvec3 key(low, t.x + t.y + t.z - low - high, high);
    std::uint64_t hash = key.x * 0x9e3779b97f4a7c15u + key.y;
    hash = (hash ^ (hash >> 29)) * 0xbf58476d1ce4e5b9u + key.z;
    std::size_t slot = (hash ^ (hash >> 31)) & mask;
    while (slots[slot] != kEmpty && keys[slots[slot]] != key) slot = (slot + 1) & mask;
    if (slots[slot] != kEmpty) {
      ++stats.duplicateTriangles;
      continue;
    }
    slots[slot] = static_cast<std::uint32_t>(keys.size());
    keys.push_back(key);
    kept.push_back(t);
  }
  return kept;
}

}  // namespace hlodbench
