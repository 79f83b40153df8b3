#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "hlod/scene/triangle_mesh.h"

namespace hlodbench::courtyard {

// How a closed surface is cut into quads; each quad becomes two triangles.
struct Lattice {
  enum class Topology {
    kSolid,  // the boundary of a block of cells.x * cells.y * cells.z cells
    kTorus,  // a grid of cells.x * cells.y quads, joined at both pairs of ends; cells.z unused
  };
  Topology topology = Topology::kSolid;
  glm::ivec3 cells{1};
  // kSolid only: the cells of the xy grid (x fastest) that are cut out through all of z. Empty:
  // none is. Two holes, or a hole and the outside, must not touch at a corner only.
  std::vector<bool> removed;
  // Where along x and y the parts of a wall begin, ends included; used by walls alone.
  std::vector<int> xBreaks;
  std::vector<int> yBreaks;
};

// One closed 2-manifold surface, at any fineness.
struct Body {
  // The lattice for a density in cells per metre; cell counts never fall when the density rises.
  std::function<Lattice(double density)> lattice;
  // Where a lattice vertex lies, in metres. For kSolid the block's x, y, z axes must map to a
  // right-handed frame; for kTorus x, y and the outward normal must.
  std::function<glm::dvec3(const Lattice& lattice, const glm::ivec3& vertex)> place;
};

// A turn about the y axis (radians), a scale, then a shift.
struct Placement {
  glm::dvec3 origin{0.0};
  double yaw = 0.0;
  double scale = 1.0;

  [[nodiscard]] glm::dvec3 apply(const glm::dvec3& point) const;
};

// The body moved; the fineness follows the scale.
Body movedBody(Body body, const Placement& placement);

// An object of the scene before it is cut into triangles.
struct ObjectPlan {
  std::string name;
  glm::vec3 color{0.75f};  // linear RGB
  std::vector<Body> bodies;
};

// The object with every body moved.
ObjectPlan movedObject(ObjectPlan object, const Placement& placement);

// Number of triangles of the surface; exact.
std::uint64_t computeTriangleCount(const Lattice& lattice);

// Adds the body's vertices and triangles, as triangles of `object`.
void appendBody(const Body& body, double density, std::uint32_t object, TriangleMesh& mesh);

}  // namespace hlodbench::courtyard
