#pragma once

#include <span>
#include <vector>

#include "hlod/build/local_index.h"
#include "hlod/build/octree.h"
#include "hlod/build/welded_mesh.h"

namespace hlodbench {

// Which normals the vertices of LODs have.
enum class LodNormals {
  kOriginal,  // those of the full-resolution surface at the same points
  kSmoothed   // of the LOD's own faces, weighted by area: means over what a face stands for
};

// The unit normals of a LOD's own faces by local number. Vertices that are locked keep the mesh's,
// so that shading goes on across borders, and so do those whose faces cancel out or say the
// opposite.
// local: has numbered the vertices of `triangles`; node: whose LOD it is.
std::vector<glm::vec3> computeSmoothedNormals(const WeldedMesh& mesh,
                                              std::span<const glm::uvec3> triangles,
                                              const OctreeNode& node, LocalIndex& local);

}  // namespace hlodbench
