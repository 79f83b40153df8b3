#pragma once

#include <span>
#include <vector>

#include "hlod/build/octree.h"
#include "hlod/build/welded_mesh.h"
#include "hlod/tree/hierarchy.h"
#include "hlod/tree/node_sink.h"

namespace hlodbench {

// The triangles of one node's LOD, over the welded mesh's vertices, and its error.
struct NodeLod {
  std::vector<glm::uvec3> triangles;  // empty in a leaf: its range of the mesh is its LOD
  float error = 0.0f;
};

// The LOD's triangles of any node, leaf or not.
std::span<const glm::uvec3> lodTriangles(const WeldedMesh& mesh, const OctreeNode& node,
                                         const NodeLod& lod);

// A vertex as hierarchies hold it. mesh.objects must be below kMaxObjects.
Vertex packVertex(const WeldedMesh& mesh, std::uint32_t v);

// Throws InputError when there are more objects than vertices can tell apart.
void checkObjectCount(std::size_t objects);

// Gives the LOD of every node to the sink, numbered as in the tree, vertices in the order of first
// use; from `threads` threads.
void sendGeometry(const WeldedMesh& mesh, const Octree& tree, const std::vector<NodeLod>& lods,
                  unsigned threads, NodeSink& sink);

// A hierarchy in memory. Throws InputError as checkObjectCount() does.
Hierarchy assembleHierarchy(const WeldedMesh& mesh, const Octree& tree,
                            const std::vector<NodeLod>& lods,
                            const std::vector<SceneObject>& objects, unsigned threads);

}  // namespace hlodbench
