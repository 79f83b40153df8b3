#include "hlod/build/winding.h"

#include <algorithm>

namespace hlodbench {
namespace {

bool hasThreeCorners(const glm::uvec3& t) {
  return t.x != t.y && t.y != t.z && t.z != t.x;
}

// Calls fn(from, to) for the directed edges of a triangle.
template <typename Fn>
void forEachEdge(const glm::uvec3& t, Fn&& fn) {
  fn(t.x, t.y);
  fn(t.y, t.z);
  fn(t.z, t.x);
}

}  // namespace

std::vector<std::uint64_t> WindingCheck::addChunk(const WeldedMesh& mesh,
                                                  std::span<const SharedPlace> places) {
  // The ends of the edges that begin at each vertex, one vertex after the other.
  std::vector<std::uint32_t> next(mesh.positions.size() + 1, 0);
  for (const glm::uvec3& t : mesh.triangles)
    if (hasThreeCorners(t))
      forEachEdge(t, [&](std::uint32_t from, std::uint32_t) { ++next[from + 1]; });
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  std::vector<std::uint32_t> ends(next.back());
  for (const glm::uvec3& t : mesh.triangles)
    if (hasThreeCorners(t))
      forEachEdge(t, [&](std::uint32_t from, std::uint32_t to) { ends[next[from]++] = to; });
  for (std::size_t v = 0, begin = 0; v < mesh.positions.size(); begin = next[v++]) {
    const auto first = ends.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = ends.begin() + static_cast<std::ptrdiff_t>(next[v]);
    std::sort(first, last);
    if (std::adjacent_find(first, last) != last) uneven_[mesh.objects[v]] = true;
  }

  std::vector<std::uint64_t> shared;
  if (places.empty()) return shared;
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> sharedOf(mesh.positions.size(), kNone);
  for (const SharedPlace& place : places) sharedOf[place.vertex] = place.shared;
  for (const SharedPlace& place : places) {
    const std::uint32_t begin = place.vertex == 0 ? 0 : next[place.vertex - 1];
    for (std::uint32_t i = begin; i < next[place.vertex]; ++i)
      if (const std::uint32_t to = sharedOf[ends[i]]; to != kNone)
        shared.push_back(std::uint64_t{place.shared} << 32 | to);
  }
  return shared;
}

void WindingCheck::finish(std::vector<std::uint64_t> edges,
                          const std::vector<SharedVertex>& shared) {
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i] == edges[i - 1]) uneven_[shared[edges[i] >> 32].object] = true;
}

}  // namespace hlodbench
