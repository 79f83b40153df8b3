#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "hlod/scene/triangle_mesh.h"
#include "hlod/tree/hierarchy.h"

namespace hlodbench::testing {

// Appends a closed, evenly oriented sphere of 2 n (n - 1) faces whose radius varies smoothly.
inline void addBumpySphere(TriangleMesh& mesh, int n, const glm::vec3& centre, float radius,
                           std::uint32_t object = 0) {
  while (mesh.objectTable.size() <= object)
    mesh.objectTable.push_back({"body", {0.5f, 0.6f, 0.7f}});
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  const auto point = [&](double theta, double phi) {
    const glm::dvec3 d(std::sin(theta) * std::cos(phi), std::cos(theta),
                       std::sin(theta) * std::sin(phi));
    const double bump = 1.0 + 0.15 * std::sin(5 * d.x + 1) * std::sin(7 * d.y) * std::sin(6 * d.z) +
                        0.02 * std::sin(40 * d.x) * std::sin(37 * d.y + 2);
    return centre + glm::vec3(d * bump * double(radius));
  };
  const double pi = std::acos(-1.0);
  mesh.positions.push_back(point(0, 0));
  for (int ring = 1; ring < n; ++ring)
    for (int i = 0; i < n; ++i) mesh.positions.push_back(point(pi * ring / n, 2 * pi * i / n));
  mesh.positions.push_back(point(pi, 0));
  const auto at = [&](int ring, int i) {
    return base + 1 + static_cast<std::uint32_t>((ring - 1) * n + i % n);
  };
  const auto last = static_cast<std::uint32_t>(mesh.positions.size()) - 1;
  for (int i = 0; i < n; ++i) {
    mesh.triangles.emplace_back(base, at(1, i + 1), at(1, i));
    for (int ring = 1; ring < n - 1; ++ring) {
      mesh.triangles.emplace_back(at(ring, i), at(ring, i + 1), at(ring + 1, i));
      mesh.triangles.emplace_back(at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i));
    }
    mesh.triangles.emplace_back(at(n - 1, i), at(n - 1, i + 1), last);
  }
  mesh.objects.resize(mesh.triangles.size(), object);
}

inline TriangleMesh bumpySphere(int n) {
  TriangleMesh mesh;
  addBumpySphere(mesh, n, glm::vec3(3.0f, -2.0f, 1.0f), 2.0f);
  return mesh;
}

// A soup with everything that scanners and modellers do: fans of many faces on one edge, faces
// given twice and in reverse, mixed winding, faces of two equal corners and of no area.
inline TriangleMesh nastySoup(std::uint32_t seed) {
  TriangleMesh mesh = bumpySphere(40);
  addBumpySphere(mesh, 30, glm::vec3(4.0f, -1.0f, 2.0f), 1.5f, 1);
  std::mt19937 random(seed);
  const auto vertex = [&] { return random() % static_cast<std::uint32_t>(mesh.positions.size()); };
  const std::size_t regular = mesh.triangles.size();
  for (std::size_t i = 0; i < regular; i += 3) std::swap(mesh.triangles[i].y, mesh.triangles[i].z);
  for (int i = 0; i < 300; ++i) {
    const glm::uvec3 t = mesh.triangles[random() % regular];
    mesh.triangles.push_back(t);
    mesh.triangles.emplace_back(t.z, t.y, t.x);
    mesh.triangles.emplace_back(t.x, t.y, t.x);
    mesh.triangles.emplace_back(t.x, t.y, vertex());
    mesh.triangles.emplace_back(t.x, t.y, vertex());
  }
  mesh.triangles.emplace_back(5, 5, 5);
  while (mesh.objects.size() < mesh.triangles.size()) mesh.objects.push_back(random() % 2);
  return mesh;
}

using Point = std::array<float, 3>;
using Triangle = std::array<Point, 3>;

inline Point toPoint(const glm::vec3& p) {
  return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
}

// A triangle by its positions, the least corner first, the winding kept.
inline Triangle canonical(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

inline glm::vec3 corner(const Hierarchy& h, const Node& node, std::uint64_t index) {
  return h.vertices(node)[h.indices(node)[index]].position;
}

inline std::vector<Triangle> trianglesOf(const Hierarchy& h, const Node& node) {
  std::vector<Triangle> out;
  for (std::uint32_t i = 0; i < node.indexCount; i += 3)
    out.push_back({toPoint(corner(h, node, i)), toPoint(corner(h, node, i + 1)),
                   toPoint(corner(h, node, i + 2))});
  return out;
}

// The leaves under a node, itself when it is one.
inline std::vector<NodeId> leavesUnder(const Hierarchy& h, NodeId id) {
  std::vector<NodeId> open{id}, leaves;
  while (!open.empty()) {
    const NodeId at = open.back();
    open.pop_back();
    const Node& node = h.node(at);
    if (node.isLeaf()) leaves.push_back(at);
    for (std::uint32_t i = 0; i < node.childCount; ++i) open.push_back(node.firstChild + i);
  }
  return leaves;
}

// Directed edges by position, forward minus backward uses, without those that cancel out. Empty for
// a surface without a border, crack or hole.
inline std::map<std::pair<Point, Point>, int> borderOf(const std::vector<Triangle>& triangles) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const Triangle& t : triangles)
    for (int i = 0; i < 3; ++i) {
      const Point& a = t[i];
      const Point& b = t[(i + 1) % 3];
      if (a < b) ++edges[{a, b}];
      if (b < a) --edges[{b, a}];
    }
  std::erase_if(edges, [](const auto& edge) { return edge.second == 0; });
  return edges;
}

// The triangles of a front of the tree: an inner node is refined with a chance of `refine` per
// cent.
inline std::vector<Triangle> randomFront(const Hierarchy& h, unsigned refine,
                                         std::mt19937& random) {
  std::vector<NodeId> open{kRoot};
  std::vector<Triangle> triangles;
  while (!open.empty()) {
    const Node& node = h.node(open.back());
    open.pop_back();
    if (!node.isLeaf() && random() % 100 < refine) {
      for (std::uint32_t i = 0; i < node.childCount; ++i) open.push_back(node.firstChild + i);
      continue;
    }
    for (const Triangle& t : trianglesOf(h, node)) triangles.push_back(t);
  }
  return triangles;
}

}  // namespace hlodbench::testing
