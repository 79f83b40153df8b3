// This work is based on:
// D. Schmalstieg, R. F. Tobler. Fast Projected Area Computation for Three-Dimensional Bounding
// Boxes. Journal of Graphics Tools 4(2), 1999.
#include "hlod/view/projected_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace hlodbench {
namespace {

// A silhouette: 4 corners where one face is seen, 6 where two or three are, in order around it.
struct Silhouette {
  std::uint8_t count = 0;
  std::array<std::uint8_t, 6> corners{};
};

// Corners: bit 0 = max x, bit 1 = max y, bit 2 = max z.
// Regions: per axis 0 (between the slabs), 1 (below min), 2 (above max); region = x + 3 y + 9 z.
constexpr int kRegionCount = 27;

// True when the face at the low (side 0) or high (side 1) end of an axis faces an eye in `region`.
constexpr bool isFaceSeen(int region, int axis, int side) {
  constexpr int kPower[3] = {1, 3, 9};
  const int slab = region / kPower[axis] % 3;
  return slab == (side == 0 ? 1 : 2);
}

// The silhouette edges are those between a face that is seen and one that is not. Walking the seen
// faces counter-clockwise (from outside), each such edge goes from one corner to the next one.
constexpr Silhouette makeSilhouette(int region) {
  std::array<int, 8> next{-1, -1, -1, -1, -1, -1, -1, -1};
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (int side = 0; side < 2; ++side) {
      if (!isFaceSeen(region, axis, side)) continue;
      // the face's corners, counter-clockwise seen from outside, and the neighbour across each edge
      constexpr int kU[4] = {0, 1, 1, 0};
      constexpr int kV[4] = {0, 0, 1, 1};
      for (int i = 0; i < 4; ++i) {
        const int a = side == 1 ? i : 3 - i;
        const int b = side == 1 ? (i + 1) % 4 : (7 - i - 1) % 4;
        const int from = (side << axis) | (kU[a] << u) | (kV[a] << v);
        const int to = (side << axis) | (kU[b] << u) | (kV[b] << v);
        const bool alongU = kU[a] != kU[b];
        const int otherAxis = alongU ? v : u;
        const int otherSide = alongU ? kV[a] : kU[a];
        if (!isFaceSeen(region, otherAxis, otherSide)) next[from] = to;
      }
    }
  }
  Silhouette result;
  int first = 0;
  while (first < 8 && next[first] < 0) ++first;
  if (first == 8) return result;  // the eye is inside
  int corner = first;
  do {
    result.corners[result.count++] = static_cast<std::uint8_t>(corner);
    corner = next[corner];
  } while (corner != first);
  return result;
}

constexpr std::array<Silhouette, kRegionCount> makeSilhouettes() {
  std::array<Silhouette, kRegionCount> table;
  for (int region = 0; region < kRegionCount; ++region) table[region] = makeSilhouette(region);
  return table;
}
constexpr std::array<Silhouette, kRegionCount> kSilhouettes = makeSilhouettes();

int computeRegion(const glm::dvec3& eye, const Aabb& box) {
  const auto slab = [](double e, double low, double high) {
    return e < low ? 1 : e > high ? 2 : 0;
  };
  return slab(eye.x, box.min.x, box.max.x) + 3 * slab(eye.y, box.min.y, box.max.y) +
         9 * slab(eye.z, box.min.z, box.max.z);
}

// A polygon of at most 6 corners gains at most one with each of the four clipping lines.
struct Polygon {
  std::array<glm::dvec2, 10> points;
  int count = 0;
  void add(const glm::dvec2& p) { points[count++] = p; }
};

// Sutherland-Hodgman: keeps what lies where sign * p[axis] <= sign * limit.
Polygon clip(const Polygon& in, int axis, double limit, double sign) {
  Polygon out;
  for (int i = 0; i < in.count; ++i) {
    const glm::dvec2& a = in.points[i];
    const glm::dvec2& b = in.points[(i + 1) % in.count];
    const double da = sign * (limit - a[axis]);
    const double db = sign * (limit - b[axis]);
    if (da >= 0.0) out.add(a);
    if ((da >= 0.0) != (db >= 0.0)) out.add(a + (b - a) * (da / (da - db)));
  }
  return out;
}

glm::dvec3 cornerOf(const Aabb& box, int corner) {
  return {(corner & 1) ? box.max.x : box.min.x, (corner & 2) ? box.max.y : box.min.y,
          (corner & 4) ? box.max.z : box.min.z};
}

glm::dvec2 toPixels(const Camera& camera, const glm::dvec4& p) {
  return {(p.x / p.w * 0.5 + 0.5) * camera.lens.width,
          (p.y / p.w * 0.5 + 0.5) * camera.lens.height};
}

Polygon projectSilhouette(const Camera& camera, const Aabb& box) {
  const Silhouette& silhouette = kSilhouettes[computeRegion(camera.pose.position, box)];
  Polygon polygon;
  for (int i = 0; i < silhouette.count; ++i)
    polygon.add(toPixels(
        camera, camera.viewProjection * glm::dvec4(cornerOf(box, silhouette.corners[i]), 1.0)));
  return polygon;
}

double computeArea(const Polygon& polygon) {
  double twiceArea = 0.0;
  for (int i = 0; i < polygon.count; ++i) {
    const glm::dvec2& a = polygon.points[i];
    const glm::dvec2& b = polygon.points[(i + 1) % polygon.count];
    twiceArea += a.x * b.y - b.x * a.y;
  }
  return 0.5 * std::abs(twiceArea);
}

// Pixels of the viewport that one face covers, parts behind the eye left out: clipped before the
// division, by the four planes through the eye (-w <= x, y <= w), between which w is above 0.
double computeFaceArea(const Camera& camera, const Aabb& box, int axis, int side) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  std::array<glm::dvec4, 8> points;
  int count = 0;
  for (const auto& [atU, atV] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
    points[count++] = camera.viewProjection *
                      glm::dvec4(cornerOf(box, (side << axis) | (atU << u) | (atV << v)), 1.0);
  for (const auto& [coordinate, sign] : {std::pair(0, 1.0), {0, -1.0}, {1, 1.0}, {1, -1.0}}) {
    std::array<glm::dvec4, 8> kept;
    int keptCount = 0;
    for (int i = 0; i < count; ++i) {
      const glm::dvec4& a = points[i];
      const glm::dvec4& b = points[(i + 1) % count];
      const double da = a.w - sign * a[coordinate];
      const double db = b.w - sign * b[coordinate];
      if (da >= 0.0) kept[keptCount++] = a;
      if ((da >= 0.0) != (db >= 0.0)) kept[keptCount++] = a + (b - a) * (da / (da - db));
    }
    points = kept;
    count = keptCount;
  }
  Polygon polygon;
  for (int i = 0; i < count; ++i) {
    if (!(points[i].w > 0.0)) return 0.0;  // the face's plane goes through the eye
    polygon.add(toPixels(camera, points[i]));
  }
  return computeArea(polygon);
}

}  // namespace

bool isCutByNearPlane(const Camera& camera, const Aabb& box) {
  // the corner nearest along the view direction decides for all eight
  const glm::dvec3 forward = camera.forward();
  const glm::dvec3 nearest(forward.x > 0 ? box.min.x : box.max.x,
                           forward.y > 0 ? box.min.y : box.max.y,
                           forward.z > 0 ? box.min.z : box.max.z);
  return glm::dot(forward, nearest - camera.pose.position) <= camera.lens.nearPlane;
}

double computeProjectedArea(const Camera& camera, const Aabb& box) {
  Polygon polygon = projectSilhouette(camera, box);
  for (int axis = 0; axis < 2; ++axis) {
    polygon = clip(polygon, axis, 0.0, -1.0);
    polygon = clip(polygon, axis, axis == 0 ? camera.lens.width : camera.lens.height, 1.0);
  }
  return computeArea(polygon);
}

double computeUnclippedArea(const Camera& camera, const Aabb& box) {
  return computeArea(projectSilhouette(camera, box));
}

double computeProjectedAreaOfCutBox(const Camera& camera, const Aabb& box) {
  double area = 0.0;
  const int region = computeRegion(camera.pose.position, box);
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      if (isFaceSeen(region, axis, side)) area += computeFaceArea(camera, box, axis, side);
  return area;
}

}  // namespace hlodbench
