#include "hlod/build/surface_distance.h"

#include <algorithm>
#include <array>
#include <limits>

namespace hlodbench {
namespace {

constexpr std::uint32_t kLeafSize = 2;

// A point is below a box, above it, or neither: at most one of the differences is positive.
[[gnu::always_inline]] inline float boxDistanceSquared(const Aabb& box, const glm::vec3& p) {
  const float x = std::max({box.min.x - p.x, p.x - box.max.x, 0.0f});
  const float y = std::max({box.min.y - p.y, p.y - box.max.y, 0.0f});
  const float z = std::max({box.min.z - p.z, p.z - box.max.z, 0.0f});
  return x * x + y * y + z * z;
}

float segmentDistanceSquared(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 ab = b - a;
  const float length = glm::dot(ab, ab);
  const float t = length > 0.0f ? glm::clamp(glm::dot(p - a, ab) / length, 0.0f, 1.0f) : 0.0f;
  const glm::vec3 d = p - (a + ab * t);
  return glm::dot(d, d);
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
  triangles_.resize(corners.size() / 3);
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    triangles_[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
  boxes_.reserve(triangles_.size() + 1);
  build(0, static_cast<std::uint32_t>(triangles_.size()));
}

void SurfaceDistance::build(std::uint32_t begin, std::uint32_t end) {
  Box box;
  Aabb centres;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Triangle& t = triangles_[i];
    for (const glm::vec3& corner : {t.a, t.b, t.c}) box.bounds.extend(corner);
    centres.extend(t.a + t.b + t.c);
  }
  const std::size_t self = boxes_.size();
  if (end - begin <= kLeafSize) {
    box.first = begin;
    box.count = end - begin;
    boxes_.push_back(box);
    return;
  }
  boxes_.push_back(box);
  const glm::vec3 extent = centres.max - centres.min;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle,
                   triangles_.begin() + end, [axis](const Triangle& l, const Triangle& r) {
                     return l.a[axis] + l.b[axis] + l.c[axis] < r.a[axis] + r.b[axis] + r.c[axis];
                   });
  build(begin, middle);
  boxes_[self].first = static_cast<std::uint32_t>(boxes_.size());
  build(middle, end);
}

float SurfaceDistance::distanceSquaredTo(std::uint32_t hint, const glm::vec3& p) const {
  const Triangle& t = triangles_[hint];
  return pointTriangleDistanceSquared(p, t.a, t.b, t.c);
}

float SurfaceDistance::distanceSquared(const glm::vec3& p, float enough,
                                       std::uint32_t& hint) const {
  const Triangle& start = triangles_[hint];
  float best = pointTriangleDistanceSquared(p, start.a, start.b, start.c);
  struct Entry {
    std::uint32_t box;
    float distance;
  };
  std::array<Entry, 64> stack;  // the tree is balanced: 2^32 triangles make 32 levels
  std::size_t size = 0;
  stack[size++] = {0, boxDistanceSquared(boxes_[0].bounds, p)};
  while (size > 0 && best > enough) {
    const Entry entry = stack[--size];
    if (entry.distance >= best) continue;
    const Box& box = boxes_[entry.box];
    for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {
      const Triangle& t = triangles_[i];
      const float d = pointTriangleDistanceSquared(p, t.a, t.b, t.c);
      if (d >= best) continue;
      best = d;
      hint = i;
    }
    if (box.count > 0) continue;
    Entry near{entry.box + 1, boxDistanceSquared(boxes_[entry.box + 1].bounds, p)};
    Entry far{box.first, boxDistanceSquared(boxes_[box.first].bounds, p)};
    if (far.distance < near.distance) std::swap(near, far);
    if (far.distance < best) stack[size++] = far;
    if (near.distance < best) stack[size++] = near;
  }
  return best;
}

}  // namespace hlodbench
