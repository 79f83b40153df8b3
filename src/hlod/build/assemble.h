#pragma once

#include <span>
#include <vector>

#include "hlod/build/octree.h"
#include "hlod/build/welded_mesh.h"
#include "hlod/tree/hierarchy.h"

namespace hlodbench {

// The triangles of one node's LOD, over the welded mesh's vertices, and its error.
struct NodeLod {
  std::vector<glm::uvec3> triangles;  // empty in a leaf: its range of the mesh is its LOD
  float error = 0.0f;
};

// The LOD's triangles of any node, leaf or not.
std::span<const glm::uvec3> lodTriangles(const WeldedMesh& mesh, const OctreeNode& node,
                                         const NodeLod& lod);

// Lays the nodes out as the renderer takes them: a block of vertices and one of indices a node,
// vertices in the order of first use.
Hierarchy assembleHierarchy(const WeldedMesh& mesh, const Octree& tree,
                            const std::vector<NodeLod>& lods,
                            const std::vector<SceneObject>& objects, unsigned threads);

}  // namespace hlodbench
