#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace hlodbench {

// One instance of a mesh in a scene.
struct SceneObject {
  std::string name;
  glm::vec3 color{0.75f};  // linear RGB, 0 to 1
};

// A triangle soup in world units: what a scene is flattened to, and all the hierarchy is built
// from. Nothing is assumed of it: it may be non-manifold, with mixed winding, duplicated or
// degenerate faces; front faces are counter-clockwise where the source says so.
struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;   // indices into positions
  std::vector<std::uint32_t> objects;  // one a triangle: index into objectTable
  std::vector<SceneObject> objectTable;
};

}  // namespace hlodbench
