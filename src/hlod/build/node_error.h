#pragma once

#include <cstdint>
#include <span>

#include "hlod/build/border_locks.h"
#include "hlod/build/octree.h"
#include "hlod/build/welded_mesh.h"

namespace hlodbench {

// The distance (world units, >= childError) from the original surface of a node to its LOD: the
// largest over all original vertices and over `faceSamples` random points of the original faces,
// uniform by area, the same in every run. One side only: the distance from the LOD to the original
// is not promised. Of the points of the original surface at most about 1 / faceSamples may lie
// further away.
// lod: triangles over the mesh's vertices, at least one; childError: the children's largest error.
float computeNodeError(const WeldedMesh& mesh, const BorderLocks& locks, const OctreeNode& node,
                       std::span<const glm::uvec3> lod, std::uint32_t faceSamples,
                       float childError);

}  // namespace hlodbench
