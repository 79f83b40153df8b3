#include "hlod/build/surface_distance.h"

#include <algorithm>
#include <array>
#include <limits>

namespace hlodbench {
namespace {

constexpr float kTiny = 1e-30f;  // keeps divisions by 0 away

float segmentDistanceSquared(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 ab = b - a;
  const float length = glm::dot(ab, ab);
  const float t = length > 0.0f ? glm::clamp(glm::dot(p - a, ab) / length, 0.0f, 1.0f) : 0.0f;
  const glm::vec3 d = p - (a + ab * t);
  return glm::dot(d, d);
}

// Numbers and vectors of four triangles at once.
typedef float Four __attribute__((vector_size(16)));

inline Four larger(const Four& a, const Four& b) {
  return a > b ? a : b;
}

inline Four smaller(const Four& a, const Four& b) {
  return a < b ? a : b;
}

struct FourVectors {
  Four x, y, z;
};

inline FourVectors operator-(const FourVectors& a, const FourVectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline Four dot(const FourVectors& a, const FourVectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline FourVectors cross(const FourVectors& a, const FourVectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// p: from the edge's begin; length: the edge's, squared.
inline Four toSegment(const FourVectors& p, const FourVectors& edge, const Four& length) {
  const Four along = dot(p, edge) / larger(length, Four{} + kTiny);
  const Four s = smaller(larger(along, Four{}), Four{} + 1.0f);
  const FourVectors d{p.x - s * edge.x, p.y - s * edge.y, p.z - s * edge.z};
  return dot(d, d);
}

}  // namespace

float pointTriangleDistanceSquared(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b,
                                   const glm::vec3& c) {
  const glm::vec3 ab = b - a;
  const glm::vec3 ac = c - a;
  const glm::vec3 ap = p - a;
  const float d1 = glm::dot(ab, ap);
  const float d2 = glm::dot(ac, ap);
  if (d1 <= 0.0f && d2 <= 0.0f) return glm::dot(ap, ap);
  const glm::vec3 bp = p - b;
  const float d3 = glm::dot(ab, bp);
  const float d4 = glm::dot(ac, bp);
  if (d3 >= 0.0f && d4 <= d3) return glm::dot(bp, bp);
  const glm::vec3 cp = p - c;
  const float d5 = glm::dot(ab, cp);
  const float d6 = glm::dot(ac, cp);
  if (d6 >= 0.0f && d5 <= d6) return glm::dot(cp, cp);
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) return segmentDistanceSquared(p, a, b);
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) return segmentDistanceSquared(p, a, c);
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) return segmentDistanceSquared(p, b, c);
  const glm::vec3 normal = glm::cross(ab, ac);
  const float length = glm::dot(normal, normal);
  if (length > 1e-12f * glm::dot(ab, ab) * glm::dot(ac, ac)) {
    const float height = glm::dot(ap, normal);
    return height * height / length;
  }
  // Without area, or so thin that its plane is not known: the nearest of the edges.
  return std::min({segmentDistanceSquared(p, a, b), segmentDistanceSquared(p, a, c),
                   segmentDistanceSquared(p, b, c)});
}

SurfaceDistance::SurfaceDistance(std::span<const glm::vec3> corners) {
  std::vector<Centre> centres(corners.size() / 3);
  for (std::uint32_t i = 0; i < centres.size(); ++i)
    centres[i] = {corners[3 * i] + corners[3 * i + 1] + corners[3 * i + 2], i};
  triangles_.reserve(corners.size() * 2);
  packets_.reserve(corners.size() / 3);
  boxes_.reserve(corners.size() / 6 + 1);
  Aabb bounds;
  root_ = build(centres, corners, bounds);
}

std::uint32_t SurfaceDistance::build(std::span<Centre> centres, std::span<const glm::vec3> corners,
                                     Aabb& bounds) {
  if (centres.size() <= kLanes) return addPacket(centres, corners, bounds);
  // Halves, and halves of these.
  const auto halve = [](std::span<Centre> all) {
    Aabb box;
    for (const Centre& centre : all) box.extend(centre.point);
    const glm::vec3 extent = box.max - box.min;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    const std::size_t middle = all.size() / 2;
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(middle), all.end(),
                     [axis](const Centre& l, const Centre& r) {
                       return l.point[axis] != r.point[axis] ? l.point[axis] < r.point[axis]
                                                             : l.triangle < r.triangle;
                     });
    return std::array{all.first(middle), all.subspan(middle)};
  };
  const auto self = static_cast<std::uint32_t>(boxes_.size());
  boxes_.emplace_back();
  int lane = 0;
  for (const std::span<Centre> half : halve(centres)) {
    for (const std::span<Centre> quarter : halve(half)) {
      Aabb box;
      const std::uint32_t child = build(quarter, corners, box);
      for (int axis = 0; axis < 3; ++axis) {
        boxes_[self].min[axis][lane] = box.min[axis];
        boxes_[self].max[axis][lane] = box.max[axis];
      }
      boxes_[self].child[lane++] = child;
      bounds.extend(box);
    }
  }
  return self;
}

std::uint32_t SurfaceDistance::addPacket(std::span<const Centre> centres,
                                         std::span<const glm::vec3> corners, Aabb& bounds) {
  Packet packet;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const std::size_t first = 3 * centres[std::min(lane, centres.size() - 1)].triangle;
    const Triangle t{corners[first], corners[first + 1], corners[first + 2]};
    for (const glm::vec3& corner : {t.a, t.b, t.c}) bounds.extend(corner);
    for (int axis = 0; axis < 3; ++axis) {
      packet.a[axis][lane] = t.a[axis];
      packet.ab[axis][lane] = t.b[axis] - t.a[axis];
      packet.ac[axis][lane] = t.c[axis] - t.a[axis];
    }
    triangles_.push_back(t);
  }
  packets_.push_back(packet);
  return static_cast<std::uint32_t>(packets_.size() - 1) | kIsPacket;
}

float SurfaceDistance::distanceSquaredTo(std::uint32_t hint, const glm::vec3& p) const {
  const Triangle& t = triangles_[hint];
  return pointTriangleDistanceSquared(p, t.a, t.b, t.c);
}

// Squared distances to the four boxes. A point is below a box, above it or neither: at most one of
// the differences is positive.
inline SurfaceDistance::Four SurfaceDistance::boxDistances(const Box& box, const glm::vec3& p) {
  Four sum{};
  for (int axis = 0; axis < 3; ++axis) {
    const Four below = box.min[axis] - p[axis];
    const Four above = p[axis] - box.max[axis];
    const Four outside = larger(larger(below, above), Four{});
    sum += outside * outside;
  }
  return sum;
}

// Squared distances to the four triangles, without branches: that to the plane where the point is
// above the inside, else that to the nearest edge. Thin triangles have no inside: their plane is
// not well known.
inline SurfaceDistance::Four SurfaceDistance::packetDistances(const Packet& t, const glm::vec3& p) {
  const FourVectors ab{t.ab[0], t.ab[1], t.ab[2]};
  const FourVectors ac{t.ac[0], t.ac[1], t.ac[2]};
  const FourVectors ap{p.x - t.a[0], p.y - t.a[1], p.z - t.a[2]};
  const FourVectors normal = cross(ab, ac);
  const Four n2 = dot(normal, normal);
  const Four ab2 = dot(ab, ab);
  const Four ac2 = dot(ac, ac);
  const Four v = dot(cross(ap, ac), normal);
  const Four w = dot(cross(ab, ap), normal);
  const Four height = dot(ap, normal);
  const FourVectors bc = ac - ab;
  const Four toEdge = smaller(smaller(toSegment(ap, ab, ab2), toSegment(ap, ac, ac2)),
                              toSegment(ap - ab, bc, dot(bc, bc)));
  const Four toPlane = height * height / larger(n2, Four{} + kTiny);
  const auto inside = (v >= 0.0f) & (w >= 0.0f) & (v + w <= n2) & (n2 > 1e-10f * ab2 * ac2);
  return inside ? toPlane : toEdge;
}

float SurfaceDistance::distanceSquared(const glm::vec3& p, float enough,
                                       std::uint32_t& hint) const {
  float best = distanceSquaredTo(hint, p);
  struct Entry {
    std::uint32_t child;
    float distance;
  };
  std::array<Entry, 64> stack;  // the tree is balanced: 2^32 triangles make 16 levels
  std::size_t size = 0;
  stack[size++] = {root_, 0.0f};
  while (size > 0 && best > enough) {
    const Entry entry = stack[--size];
    if (entry.distance >= best) continue;
    Four distances;
    if ((entry.child & kIsPacket) != 0) {
      const std::uint32_t packet = entry.child & ~kIsPacket;
      distances = packetDistances(packets_[packet], p);
      for (int lane = 0; lane < kLanes; ++lane) {
        if (distances[lane] >= best) continue;
        best = distances[lane];
        hint = kLanes * packet + static_cast<std::uint32_t>(lane);
      }
      continue;
    }
    distances = boxDistances(boxes_[entry.child], p);
    // The nearest goes on top.
    const std::size_t first = size;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (distances[lane] >= best) continue;
      std::size_t at = size++;
      for (; at > first && stack[at - 1].distance < distances[lane]; --at)
        stack[at] = stack[at - 1];
      stack[at] = {boxes_[entry.child].child[lane], distances[lane]};
    }
  }
  return best;
}

}  // namespace hlodbench
