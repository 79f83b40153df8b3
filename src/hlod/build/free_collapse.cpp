#include "hlod/build/free_collapse.h"

#include <OpenMesh/Core/Geometry/VectorT.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>
// After the two above, which it needs and does not include itself.
#include <OpenMesh/Core/Geometry/QuadricT.hh>

#include <algorithm>
#include <cmath>

namespace hlodbench {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr double kBorderWeight = 10.0;    // as in QuadricModule
constexpr double kShortEdgeFirst = 1e-9;  // as there, but faces may have become flat by now

struct Planes {
  OpenMesh::Geometry::Quadricd quadric{};
  double weight = 0.0;
  void add(const glm::dvec3& normal, const glm::dvec3& onPlane, double planeWeight) {
    OpenMesh::Geometry::Quadricd q(normal.x, normal.y, normal.z, -glm::dot(normal, onPlane));
    q *= planeWeight;
    quadric += q;
    weight += planeWeight;
  }
  void add(const Planes& other) {
    quadric += other.quadric;
    weight += other.weight;
  }
  [[nodiscard]] double error(const glm::vec3& p) const {
    return weight > 0.0 ? std::max(0.0, quadric(OpenMesh::Vec3d(p.x, p.y, p.z))) / weight : 0.0;
  }
};

struct Collapse {
  double error;
  std::uint32_t from;
  std::uint32_t to;
};

class FreeCollapser {
 public:
  FreeCollapser(const SimplifierInput& input, std::vector<glm::uvec3> triangles)
      : input_(input), triangles_(std::move(triangles)), planes_(input.positions.size()) {
    computePlanes();
  }

  std::vector<glm::uvec3> run(SimplifierStats& stats) {
    bool guarded = true;
    while (triangles_.size() > input_.targetTriangles) {
      const bool moved = pass(guarded, stats);
      if (!moved && !guarded) break;
      guarded = moved && guarded;
    }
    return std::move(triangles_);
  }

 private:
  [[nodiscard]] glm::dvec3 point(std::uint32_t v) const { return glm::dvec3(input_.positions[v]); }

  void computePlanes() {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> edges;  // and the opposite corner's face
    for (std::uint32_t face = 0; face < triangles_.size(); ++face) {
      const glm::uvec3& t = triangles_[face];
      const glm::dvec3 cross = glm::cross(point(t.y) - point(t.x), point(t.z) - point(t.x));
      const double length = glm::length(cross);
      for (int k = 0; k < 3; ++k) {
        if (length > 0.0) planes_[t[k]].add(cross / length, point(t.x), std::sqrt(0.5 * length));
        const auto [low, high] = std::minmax({t[k], t[(k + 1) % 3]});
        edges.emplace_back(std::uint64_t{low} << 32 | high, face);
      }
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool shared = (i > 0 && edges[i - 1].first == edges[i].first) ||
                          (i + 1 < edges.size() && edges[i + 1].first == edges[i].first);
      if (!shared) addBorder(edges[i].first, triangles_[edges[i].second]);
    }
  }

  void addBorder(std::uint64_t edge, const glm::uvec3& t) {
    const auto a = static_cast<std::uint32_t>(edge >> 32);
    const auto b = static_cast<std::uint32_t>(edge & 0xffffffffu);
    const glm::dvec3 along = point(b) - point(a);
    const glm::dvec3 cross =
        glm::cross(along, glm::cross(point(t.y) - point(t.x), point(t.z) - point(t.x)));
    const double length = glm::length(cross);
    if (!(length > 0.0)) return;
    for (const std::uint32_t v : {a, b})
      planes_[v].add(cross / length, point(a), kBorderWeight * glm::length(along));
  }

  // The faces around each vertex: faces_[firstFace_[v]] .. faces_[firstFace_[v + 1] - 1].
  void computeFaces() {
    firstFace_.assign(input_.positions.size() + 1, 0);
    for (const glm::uvec3& t : triangles_)
      for (int k = 0; k < 3; ++k) ++firstFace_[t[k] + 1];
    for (std::size_t v = 1; v < firstFace_.size(); ++v) firstFace_[v] += firstFace_[v - 1];
    faces_.resize(triangles_.size() * 3);
    std::vector<std::uint32_t> next(firstFace_.begin(), firstFace_.end() - 1);
    for (std::uint32_t face = 0; face < triangles_.size(); ++face)
      for (int k = 0; k < 3; ++k) faces_[next[triangles_[face][k]]++] = face;
  }

  [[nodiscard]] std::span<const std::uint32_t> facesOf(std::uint32_t v) const {
    return std::span(faces_).subspan(firstFace_[v], firstFace_[v + 1] - firstFace_[v]);
  }

  [[nodiscard]] bool turnsFaceOver(std::uint32_t from, std::uint32_t to) const {
    for (const std::uint32_t face : facesOf(from)) {
      const glm::uvec3& t = triangles_[face];
      if (t.x == to || t.y == to || t.z == to) continue;
      const int k = t.x == from ? 0 : t.y == from ? 1 : 2;
      const glm::vec3& a = input_.positions[t[(k + 1) % 3]];
      const glm::vec3& b = input_.positions[t[(k + 2) % 3]];
      const glm::vec3 before = glm::cross(a - input_.positions[from], b - input_.positions[from]);
      const glm::vec3 after = glm::cross(a - input_.positions[to], b - input_.positions[to]);
      if (glm::dot(before, before) > 0.0f && glm::dot(before, after) <= 0.0f) return true;
    }
    return false;
  }

  [[nodiscard]] Collapse bestCollapse(std::uint32_t from, bool guarded) const {
    Collapse best{0.0, from, kNone};
    for (const std::uint32_t face : facesOf(from)) {
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t to = triangles_[face][k];
        if (to == from) continue;
        const glm::vec3 edge = input_.positions[to] - input_.positions[from];
        const double error = planes_[from].error(input_.positions[to]) +
                             kShortEdgeFirst * static_cast<double>(glm::dot(edge, edge));
        if (best.to != kNone && error >= best.error) continue;
        if (guarded && turnsFaceOver(from, to)) continue;
        best = {error, from, to};
      }
    }
    return best;
  }

  // Does the cheapest collapses that do not touch each other; false when there was none.
  bool pass(bool guarded, SimplifierStats& stats) {
    computeFaces();
    std::vector<Collapse> collapses;
    for (std::uint32_t v = 0; v < input_.positions.size(); ++v) {
      if (input_.locked[v] != 0 || facesOf(v).empty()) continue;
      const Collapse best = bestCollapse(v, guarded);
      if (best.to != kNone) collapses.push_back(best);
    }
    if (collapses.empty()) return false;
    std::sort(collapses.begin(), collapses.end(), [](const Collapse& a, const Collapse& b) {
      return a.error != b.error ? a.error < b.error : a.from < b.from;
    });
    // Collapses much dearer than those wanted wait for the next pass, which knows cheaper ones.
    const std::size_t excess = triangles_.size() - input_.targetTriangles;
    const double limit = 1.5 * collapses[std::min(excess / 2, collapses.size() - 1)].error;
    std::vector<std::uint8_t> touched(input_.positions.size(), 0);
    std::vector<std::uint32_t> target(input_.positions.size(), kNone);
    std::size_t removed = 0;
    for (const Collapse& c : collapses) {
      if (removed >= excess || c.error > limit) break;
      if (touched[c.from] != 0 || touched[c.to] != 0) continue;
      for (const std::uint32_t face : facesOf(c.from)) {
        const glm::uvec3& t = triangles_[face];
        removed += t.x == c.to || t.y == c.to || t.z == c.to ? 1 : 0;
        for (int k = 0; k < 3; ++k) touched[t[k]] = 1;
      }
      if (!guarded && turnsFaceOver(c.from, c.to)) ++stats.foldedFaces;
      target[c.from] = c.to;
      planes_[c.to].add(planes_[c.from]);
    }
    apply(target);
    return true;
  }

  void apply(const std::vector<std::uint32_t>& target) {
    for (glm::uvec3& t : triangles_)
      for (int k = 0; k < 3; ++k)
        if (target[t[k]] != kNone) t[k] = target[t[k]];
    SimplifierStats ignored;
    triangles_ =
        removeUselessTriangles({input_.positions, triangles_, input_.locked, {}, 0}, ignored);
  }

  const SimplifierInput& input_;
  std::vector<glm::uvec3> triangles_;
  std::vector<Planes> planes_;
  std::vector<std::uint32_t> firstFace_;
  std::vector<std::uint32_t> faces_;
};

}  // namespace

std::vector<glm::uvec3> collapseFreely(const SimplifierInput& input,
                                       std::vector<glm::uvec3> triangles, SimplifierStats& stats) {
  return FreeCollapser(input, std::move(triangles)).run(stats);
}

}  // namespace hlodbench
