#include "hlod/build/manifold_parts.h"

#include <algorithm>
#include <numeric>

namespace hlodbench {
namespace {

// Corner 3 f + k is the k-th of face f; it also stands for the edge from there to the next corner.
using Corner = std::uint32_t;
constexpr Corner kNoCorner = 0xffffffffu;

Corner nextCorner(Corner c) {
  return c % 3 == 2 ? c - 2 : c + 1;
}

class Partition {
 public:
  explicit Partition(std::span<const glm::uvec3> triangles)
      : triangles_(triangles), mates_(triangles.size() * 3, kNoCorner) {}

  ManifoldParts run() {
    joinEdges();
    orientFaces();
    joinCorners();
    return collect();
  }

 private:
  struct Edge {
    std::uint64_t key;
    Corner corner;
  };

  [[nodiscard]] std::uint32_t vertexOf(Corner c) const {
    return triangles_[c / 3][static_cast<int>(c % 3)];
  }

  void join(Corner a, Corner b) {
    mates_[a] = b;
    mates_[b] = a;
  }

  void joinEdges() {
    std::vector<Edge> edges(mates_.size());
    for (Corner c = 0; c < edges.size(); ++c) {
      const auto [low, high] = std::minmax({vertexOf(c), vertexOf(nextCorner(c))});
      edges[c] = {std::uint64_t{low} << 32 | high, c};
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
      return a.key != b.key ? a.key < b.key : a.corner < b.corner;
    });
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && edges[end].key == edges[begin].key) ++end;
      if (end - begin == 2) join(edges[begin].corner, edges[begin + 1].corner);
      if (end - begin > 2) joinInPairs({edges.data() + begin, end - begin});
    }
  }

  void joinInPairs(std::span<const Edge> edges) {
    std::vector<Corner> up;
    std::vector<Corner> down;
    for (const Edge& edge : edges)
      (vertexOf(edge.corner) == edge.key >> 32 ? up : down).push_back(edge.corner);
    for (std::size_t i = 0; i < std::min(up.size(), down.size()); ++i) join(up[i], down[i]);
  }

  // Walks over each part from its first face; where the walk comes back to a face the other way
  // round (a Moebius strip), the edge is cut.
  void orientFaces() {
    constexpr std::uint8_t kUnknown = 2;
    flipped_.assign(triangles_.size(), kUnknown);
    std::vector<std::uint32_t> open;
    for (std::uint32_t start = 0; start < triangles_.size(); ++start) {
      if (flipped_[start] != kUnknown) continue;
      flipped_[start] = 0;
      open.push_back(start);
      while (!open.empty()) {
        const std::uint32_t face = open.back();
        open.pop_back();
        for (Corner c = 3 * face; c < 3 * face + 3; ++c) {
          const Corner mate = mates_[c];
          if (mate == kNoCorner) continue;
          const bool sameWay = vertexOf(c) == vertexOf(mate);
          const auto wanted = static_cast<std::uint8_t>(flipped_[face] ^ (sameWay ? 1 : 0));
          std::uint8_t& other = flipped_[mate / 3];
          if (other == kUnknown) {
            other = wanted;
            open.push_back(mate / 3);
          } else if (other != wanted) {
            mates_[c] = mates_[mate] = kNoCorner;
          }
        }
      }
    }
  }

  Corner rootOf(Corner c) {
    while (roots_[c] != c) c = roots_[c] = roots_[roots_[c]];
    return c;
  }

  // Corners that joined edges connect are one vertex.
  void joinCorners() {
    roots_.resize(mates_.size());
    std::iota(roots_.begin(), roots_.end(), 0u);
    for (Corner c = 0; c < mates_.size(); ++c) {
      const Corner mate = mates_[c];
      if (mate == kNoCorner || mate < c) continue;
      const bool sameWay = vertexOf(c) == vertexOf(mate);
      roots_[rootOf(c)] = rootOf(sameWay ? mate : nextCorner(mate));
      roots_[rootOf(nextCorner(c))] = rootOf(sameWay ? nextCorner(mate) : mate);
    }
  }

  ManifoldParts collect() {
    ManifoldParts parts;
    parts.triangles.resize(triangles_.size());
    std::vector<std::uint32_t> vertexOfRoot(mates_.size(), kNoCorner);
    for (Corner c = 0; c < mates_.size(); ++c) {
      std::uint32_t& vertex = vertexOfRoot[rootOf(c)];
      if (vertex == kNoCorner) {
        vertex = static_cast<std::uint32_t>(parts.source.size());
        parts.source.push_back(vertexOf(c));
      }
      parts.triangles[c / 3][static_cast<int>(c % 3)] = vertex;
    }
    for (std::size_t face = 0; face < flipped_.size(); ++face)
      if (flipped_[face] != 0) std::swap(parts.triangles[face].y, parts.triangles[face].z);
    parts.flipped = std::move(flipped_);
    return parts;
  }

  std::span<const glm::uvec3> triangles_;
  std::vector<Corner> mates_;  // the same edge in the neighbouring face
  std::vector<std::uint8_t> flipped_;
  std::vector<Corner> roots_;  // union-find over corners
};

}  // namespace

ManifoldParts computeManifoldParts(std::span<const glm::uvec3> triangles) {
  return Partition(triangles).run();
}

}  // namespace hlodbench
