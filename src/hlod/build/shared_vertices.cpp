#include "hlod/build/shared_vertices.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hlod/core/parallel_for.h"

namespace hlodbench {
namespace {

// The faces of one chunk around a vertex that another chunk may have, too.
struct Candidate {
  glm::vec3 position;
  std::uint32_t object;
  std::uint32_t chunk;
  glm::dvec3 sum;  // of the faces' normals
  double length;   // of them
  glm::vec3 any;   // the normal of one of them
};

std::tuple<float, float, float> keyOf(const glm::vec3& p) {
  return {p.x, p.y, p.z};
}

bool isBefore(const Candidate& a, const Candidate& b) {
  return std::tuple(keyOf(a.position), a.object, a.chunk) <
         std::tuple(keyOf(b.position), b.object, b.chunk);
}

void join(Candidate& into, const Candidate& from) {
  into.sum += from.sum;
  into.length += from.length;
  into.any = chooseNormal(into.any, from.any);
}

// One corner's part; sorted fully, so that sums do not depend on the order of the triangles.
std::vector<Candidate> joinCorners(std::vector<Candidate> corners) {
  std::sort(corners.begin(), corners.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(keyOf(a.position), a.object, a.sum.x, a.sum.y, a.sum.z) <
           std::tuple(keyOf(b.position), b.object, b.sum.x, b.sum.y, b.sum.z);
  });
  std::size_t used = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (used > 0 && corners[used - 1].position == corners[i].position &&
        corners[used - 1].object == corners[i].object)
      join(corners[used - 1], corners[i]);
    else
      corners[used++] = corners[i];
  }
  corners.resize(used);
  return corners;
}

bool contains(const Aabb& box, const glm::vec3& p) {
  return p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y &&
         p.z >= box.min.z && p.z <= box.max.z;
}

bool overlap(const Aabb& a, const Aabb& b) {
  return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

std::vector<Candidate> findCandidates(std::span<const SceneTriangle> triangles, std::uint32_t chunk,
                                      const std::vector<Aabb>& boxes, double scale) {
  std::vector<Aabb> others;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (i != chunk && overlap(boxes[i], boxes[chunk])) others.push_back(boxes[i]);
  std::vector<Candidate> corners;
  for (const SceneTriangle& t : triangles) {
    for (const glm::vec3& p : t.corners) {
      if (std::none_of(others.begin(), others.end(),
                       [&](const Aabb& box) { return contains(box, p); }))
        continue;
      const glm::dvec3 cross = scaledCross(t, scale);
      const double length = glm::length(cross);
      corners.push_back({p, t.object, chunk, cross, length, unitNormal(cross, length)});
    }
  }
  return joinCorners(std::move(corners));
}

// Takes the candidates of one position, in order.
void addPosition(std::span<const Candidate> group, SharedVertices& out) {
  std::uint32_t first = group.front().chunk;
  std::uint32_t last = first;
  for (const Candidate& c : group) {
    first = std::min(first, c.chunk);
    last = std::max(last, c.chunk);
  }
  if (first == last) return;
  const bool seam = group.front().object != group.back().object;
  for (std::size_t begin = 0, end = 0; begin < group.size(); begin = end) {
    Candidate whole = group[begin];
    const auto vertex = static_cast<std::uint32_t>(out.vertices.size());
    out.ofChunk[whole.chunk].push_back(vertex);
    for (end = begin + 1; end < group.size() && group[end].object == whole.object; ++end) {
      join(whole, group[end]);
      out.ofChunk[group[end].chunk].push_back(vertex);
    }
    glm::vec3 normal = unitNormal(whole.sum, whole.length);
    if (normal == glm::vec3(0.0f)) normal = whole.any;
    if (normal == glm::vec3(0.0f)) normal = glm::vec3(0.0f, 0.0f, 1.0f);
    out.vertices.push_back({whole.position, whole.object, normal, first, last, seam});
  }
}

}  // namespace

double normalScale(const Aabb& box) {
  const glm::dvec3 extent = glm::dvec3(box.max) - glm::dvec3(box.min);
  const double size = std::max({extent.x, extent.y, extent.z});
  return size > 0.0 ? 1.0 / size : 1.0;
}

glm::dvec3 scaledCross(const SceneTriangle& t, double scale) {
  const glm::dvec3 a(t.corners[0]);
  return glm::cross((glm::dvec3(t.corners[1]) - a) * scale, (glm::dvec3(t.corners[2]) - a) * scale);
}

glm::vec3 unitNormal(const glm::dvec3& sum, double length) {
  const double left = glm::length(sum);
  // What is left of many that cancel out is rounding.
  return left > 1e-9 * length && left > 1e-60 ? glm::vec3(sum / left) : glm::vec3(0.0f);
}

glm::vec3 chooseNormal(const glm::vec3& a, const glm::vec3& b) {
  if (a == glm::vec3(0.0f) || b == glm::vec3(0.0f)) return a + b;
  return keyOf(a) > keyOf(b) ? a : b;
}

SharedVertices findSharedVertices(const ChunkStore& store, const std::vector<Aabb>& boxes,
                                  double scale, unsigned threads) {
  SharedVertices out;
  out.ofChunk.resize(boxes.size());
  if (boxes.size() < 2) return out;
  std::vector<std::vector<Candidate>> found(boxes.size());
  std::vector<std::vector<SceneTriangle>> scratch(threads);
  parallelFor(boxes.size(), threads, [&](std::size_t i, unsigned worker) {
    const auto chunk = static_cast<std::uint32_t>(i);
    found[i] = findCandidates(store.look(chunk, scratch[worker]), chunk, boxes, scale);
  });
  std::vector<Candidate> all;
  for (std::vector<Candidate>& list : found) {
    all.insert(all.end(), list.begin(), list.end());
    std::vector<Candidate>().swap(list);
  }
  std::sort(all.begin(), all.end(), isBefore);
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && all[end].position == all[begin].position) ++end;
    addPosition({all.data() + begin, end - begin}, out);
  }
  return out;
}

}  // namespace hlodbench
