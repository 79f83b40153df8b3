#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <vector>

#include "hlod/build/hierarchy_builder.h"
#include "hlod/tree/geometry_packer.h"
#include "hlod/tree/hierarchy.h"
#include "hlod/tree/octahedral.h"
#include "hlod/view/camera.h"
#include "hlod/view/frustum.h"
#include "hlod/view/projected_area.h"

// Cameras, boxes and hierarchies made by hand.
namespace hlodbench::testing {

inline Pose lookAt(const glm::dvec3& eye, const glm::dvec3& target) {
  return {eye, glm::quatLookAt(glm::normalize(target - eye), glm::dvec3(0.0, 1.0, 0.0))};
}

inline Lens makeLens(int width, int height) {
  Lens lens;
  lens.width = width;
  lens.height = height;
  lens.nearPlane = 0.1;
  return lens;
}

inline Pose makeRandomPose(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const glm::dvec3 eye(3 * uniform(random), 3 * uniform(random), 3 * uniform(random));
  return {eye, glm::normalize(
                   glm::dquat(uniform(random), uniform(random), uniform(random), uniform(random)))};
}

inline Aabb makeRandomBox(std::mt19937& random) {
  std::uniform_real_distribution<float> place(-10.0f, 10.0f);
  std::uniform_real_distribution<float> size(0.0f, 4.0f);
  const glm::vec3 min(place(random), place(random), place(random));
  return {min, min + glm::vec3(size(random), size(random), size(random))};
}

// True where an occlusion query may be asked about the box.
inline bool canBeQueried(const Camera& camera, const Aabb& box) {
  return !isCutByNearPlane(camera, box) && Frustum(camera).intersects(box);
}

// The smallest upright rectangle of the viewport that holds the box's corners, pixels.
struct Rectangle {
  glm::dvec2 min, max;
  [[nodiscard]] double perimeter() const { return 2.0 * (max.x - min.x + max.y - min.y); }
};
inline Rectangle computeScreenBounds(const Camera& camera, const Aabb& box) {
  Rectangle bounds{glm::dvec2(1e300), glm::dvec2(-1e300)};
  const glm::dvec2 size(camera.lens.width, camera.lens.height);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec4 p = camera.viewProjection * glm::dvec4((i & 1) ? box.max.x : box.min.x,
                                                            (i & 2) ? box.max.y : box.min.y,
                                                            (i & 4) ? box.max.z : box.min.z, 1.0);
    const glm::dvec2 at = (glm::dvec2(p) / p.w * 0.5 + 0.5) * size;
    bounds.min = glm::min(bounds.min, glm::clamp(at, glm::dvec2(0.0), size));
    bounds.max = glm::max(bounds.max, glm::clamp(at, glm::dvec2(0.0), size));
  }
  return bounds;
}

// A hierarchy for the renderer alone: nodes that stand side by side, without a tree above them,
// each an object of its own unless told otherwise.
class FlatHierarchy {
 public:
  // Adds a node of these triangles, which are counter-clockwise from outside. Returns its id.
  NodeId add(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
             const glm::u8vec4& color = {255, 255, 255, 255}, int object = -1) {
    const std::size_t index = object < 0 ? hierarchy.objects.size() : object;
    hierarchy.objects.resize(std::max(hierarchy.objects.size(), index + 1));
    hierarchy.objects[index] = {"node", glm::vec3(color) / 255.0f};
    Node node;
    std::vector<Vertex> vertices;
    for (const glm::vec3& p : positions) {
      node.box.extend(p);
      vertices.push_back({p, {normal[0], normal[1]}, static_cast<std::uint16_t>(index)});
    }
    std::vector<std::uint32_t> indices;
    for (const glm::uvec3& t : triangles)
      for (int i = 0; i < 3; ++i) indices.push_back(t[i]);
    node.geometryOffset = geometry_.size();
    const auto block = packer_.pack(vertices, indices, node);
    geometry_.insert(geometry_.end(), block.begin(), block.end());
    hierarchy.geometry = GeometrySection(geometry_);
    hierarchy.nodes.push_back(node);
    return static_cast<NodeId>(hierarchy.nodes.size() - 1);
  }

  // Adds a node that is its own box.
  NodeId addBox(const Aabb& box, const glm::u8vec4& color = {255, 255, 255, 255}, int object = -1) {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 8; ++i)
      corners.emplace_back((i & 1) ? box.max.x : box.min.x, (i & 2) ? box.max.y : box.min.y,
                           (i & 4) ? box.max.z : box.min.z);
    return add(corners,
               {{0, 4, 6},
                {0, 6, 2},
                {1, 3, 7},
                {1, 7, 5},
                {0, 1, 5},
                {0, 5, 4},
                {2, 6, 7},
                {2, 7, 3},
                {0, 2, 3},
                {0, 3, 1},
                {4, 5, 7},
                {4, 7, 6}},
               color, object);
  }

  Hierarchy hierarchy;
  OctahedralNormal normal{0, 127};  // of the vertices added next

 private:
  GeometryPacker packer_;
  std::vector<std::byte> geometry_;
};

inline Hierarchy buildTestHierarchy(const TriangleMesh& mesh, std::uint32_t maxTriangles) {
  BuildOptions options;
  options.maxTriangles = maxTriangles;
  options.errorSamples = 128;  // the tests need an error, not a tight one
  BuildReport report;
  return buildHierarchy(mesh, options, report);
}

}  // namespace hlodbench::testing
