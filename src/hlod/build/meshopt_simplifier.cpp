#include "hlod/build/meshopt_simplifier.h"

#ifdef HLODBENCH_HAVE_MESHOPTIMIZER

#include <meshoptimizer.h>

#include <algorithm>

#include "hlod/build/openmesh_simplifier.h"

namespace hlodbench {
namespace {

static_assert(sizeof(glm::uvec3) == 12 && sizeof(glm::vec3) == 12);

// The vertices on an edge that has not exactly one face on either side.
std::vector<std::uint8_t> computeBorderVertices(const std::vector<glm::uvec3>& triangles,
                                                std::size_t vertices) {
  // The ends of the edges that begin at each vertex, one vertex after the other.
  std::vector<std::uint32_t> next(vertices + 1, 0);
  for (const glm::uvec3& t : triangles)
    for (int corner = 0; corner < 3; ++corner) ++next[t[corner] + 1];
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  std::vector<std::uint32_t> ends(triangles.size() * 3);
  for (const glm::uvec3& t : triangles)
    for (int corner = 0; corner < 3; ++corner) ends[next[t[corner]]++] = t[(corner + 1) % 3];
  const auto hasEdge = [&](std::uint32_t from, std::uint32_t to) {
    const auto begin = ends.begin() + (from == 0 ? 0 : next[from - 1]);
    return std::find(begin, ends.begin() + next[from], to) != ends.begin() + next[from];
  };
  std::vector<std::uint8_t> border(vertices, 0);
  for (const glm::uvec3& t : triangles)
    for (int corner = 0; corner < 3; ++corner)
      if (!hasEdge(t[(corner + 1) % 3], t[corner]))
        border[t[corner]] = border[t[(corner + 1) % 3]] = 1;
  return border;
}

class MeshoptSimplifier final : public Simplifier {
 public:
  [[nodiscard]] std::vector<glm::uvec3> simplify(const SimplifierInput& input,
                                                 SimplifierStats& stats) const override {
    SimplifierStats own;
    std::vector<glm::uvec3> triangles = removeUselessTriangles(input, own);
    if (triangles.size() > input.targetTriangles) {
      std::vector<glm::uvec3> simplified = simplifyWithFins(input, triangles);
      const bool stuck = simplified.size() > input.targetTriangles * 5 / 4;
      if (stuck || !keepsLockedVertices(input, triangles, simplified)) {
        ++stats.fallbacks;
        return fallback_->simplify(input, stats);
      }
      triangles = std::move(simplified);
    }
    stats.add(own);
    return triangles;
  }

 private:
  static std::vector<glm::uvec3> simplifyWithFins(const SimplifierInput& input,
                                                  std::vector<glm::uvec3> triangles) {
    const auto vertexCount = static_cast<std::uint32_t>(input.positions.size());
    const std::size_t realTriangles = triangles.size();
    std::vector<glm::vec3> positions(input.positions.begin(), input.positions.end());
    const std::vector<std::uint8_t> border = computeBorderVertices(triangles, vertexCount);
    for (std::uint32_t v = 0; v < vertexCount; ++v) {
      if (input.locked[v] == 0 || border[v] != 0) continue;
      // Small, so that fins do not meet, and inside the node, so that its size stays the same.
      constexpr float kFin = 1e-4f;
      const glm::vec3 inward = glm::mix(glm::vec3(kFin), glm::vec3(-kFin),
                                        glm::greaterThan(positions[v], glm::vec3(0.0f)));
      const auto fin = static_cast<std::uint32_t>(positions.size());
      const glm::vec3 p = positions[v];
      positions.push_back(p + glm::vec3(inward.x, 0.0f, 0.0f));
      positions.push_back(p + glm::vec3(0.0f, inward.y, inward.z));
      triangles.emplace_back(v, fin, fin + 1);
    }
    const std::size_t fins = triangles.size() - realTriangles;
    std::vector<glm::uvec3> result(triangles.size());
    constexpr float kAnyError = 1e6f;
    const std::size_t indices =
        meshopt_simplify(&result[0].x, &triangles[0].x, triangles.size() * 3, &positions[0].x,
                         positions.size(), sizeof(glm::vec3), (input.targetTriangles + fins) * 3,
                         kAnyError, meshopt_SimplifyLockBorder, nullptr);
    result.resize(indices / 3);
    std::erase_if(result, [&](const glm::uvec3& t) {
      return t.x >= vertexCount || t.y >= vertexCount || t.z >= vertexCount;
    });
    return result;
  }

  static bool keepsLockedVertices(const SimplifierInput& input,
                                  const std::vector<glm::uvec3>& before,
                                  const std::vector<glm::uvec3>& after) {
    std::vector<std::uint8_t> missing(input.positions.size(), 0);
    for (const glm::uvec3& t : before)
      for (int corner = 0; corner < 3; ++corner) missing[t[corner]] = input.locked[t[corner]];
    for (const glm::uvec3& t : after)
      for (int corner = 0; corner < 3; ++corner) missing[t[corner]] = 0;
    return std::find(missing.begin(), missing.end(), 1) == missing.end();
  }

  std::unique_ptr<Simplifier> fallback_ = createOpenMeshSimplifier();
};

}  // namespace

std::unique_ptr<Simplifier> createMeshoptSimplifier() {
  return std::make_unique<MeshoptSimplifier>();
}

}  // namespace hlodbench

#else

namespace hlodbench {
std::unique_ptr<Simplifier> createMeshoptSimplifier() {
  return nullptr;
}
}  // namespace hlodbench

#endif
