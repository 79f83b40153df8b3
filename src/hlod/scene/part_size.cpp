#include "hlod/scene/part_size.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

namespace hlodbench {
namespace {

// Sets of vertices, each a tree of which every vertex knows a parent.
class VertexSets {
 public:
  explicit VertexSets(std::size_t vertices) : parents_(vertices) {
    std::iota(parents_.begin(), parents_.end(), 0u);
  }

  std::uint32_t find(std::uint32_t v) {
    while (parents_[v] != v) v = parents_[v] = parents_[parents_[v]];
    return v;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

void joinEqualPositions(std::span<const glm::vec3> positions, VertexSets& sets) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const glm::vec3& p = positions[a];
    const glm::vec3& q = positions[b];
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (positions[order[i]] == positions[order[i - 1]]) sets.join(order[i], order[i - 1]);
}

}  // namespace

double computeMeanPartSize(std::span<const glm::vec3> positions,
                           std::span<const glm::uvec3> triangles) {
  if (triangles.empty() || isTooLargeForParts(positions.size(), triangles.size()))
    return static_cast<double>(triangles.size());
  VertexSets sets(positions.size());
  joinEqualPositions(positions, sets);
  for (const glm::uvec3& t : triangles) {
    sets.join(t.x, t.y);
    sets.join(t.y, t.z);
  }
  std::vector<std::uint8_t> isSeen(positions.size(), 0);
  std::uint64_t parts = 0;
  for (const glm::uvec3& t : triangles) {
    std::uint8_t& seen = isSeen[sets.find(t.x)];
    parts += seen == 0 ? 1 : 0;
    seen = 1;
  }
  return static_cast<double>(triangles.size()) / static_cast<double>(parts);
}

}  // namespace hlodbench
