#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/core/aabb.h"

namespace hlodbench {

// Squared distance from a point to a triangle (a, b, c), which may be degenerate. The closest-point
// regions are those of Ericson, Real-Time Collision Detection, 5.1.5.
float pointTriangleDistanceSquared(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b,
                                   const glm::vec3& c);

// Distances from points to a set of triangles, through a tree of boxes.
class SurfaceDistance {
 public:
  // corners: 3 a triangle, at least one triangle.
  explicit SurfaceDistance(std::span<const glm::vec3> corners);

  // The squared distance from p to the nearest triangle; but once some triangle is found within
  // sqrt(enough), the search ends and the value returned is only known to be at most `enough`.
  // hint: where to look first, and then the triangle found; queries of points that lie near each
  // other should share it. 0 will do to start with.
  [[nodiscard]] float distanceSquared(const glm::vec3& p, float enough, std::uint32_t& hint) const;

  // The squared distance from p to the triangle that was found as `hint`.
  [[nodiscard]] float distanceSquaredTo(std::uint32_t hint, const glm::vec3& p) const;

 private:
  static constexpr int kLanes = 4;
  typedef float Four __attribute__((vector_size(16)));  // of GCC and Clang
  struct Triangle {
    glm::vec3 a, b, c;
  };
  // Four triangles side by side, so that one distance takes as long as four: a corner and the two
  // edges from there, each coordinate of all four together.
  struct Packet {
    Four a[3], ab[3], ac[3];
  };
  // Four children's boxes side by side. A child is a node, or kIsPacket and a packet.
  struct Box {
    Four min[3], max[3];
    std::uint32_t child[kLanes];
  };
  // What the tree is sorted by.
  struct Centre {
    glm::vec3 point;
    std::uint32_t triangle;
  };
  static constexpr std::uint32_t kIsPacket = 0x80000000u;

  static Four boxDistances(const Box& box, const glm::vec3& p);
  static Four packetDistances(const Packet& packet, const glm::vec3& p);
  std::uint32_t build(std::span<Centre> centres, std::span<const glm::vec3> corners, Aabb& bounds);
  std::uint32_t addPacket(std::span<const Centre> centres, std::span<const glm::vec3> corners,
                          Aabb& bounds);

  std::vector<Triangle> triangles_;  // four a packet, where there are fewer the last one again
  std::vector<Packet> packets_;
  std::vector<Box> boxes_;
  std::uint32_t root_ = 0;
};

}  // namespace hlodbench
