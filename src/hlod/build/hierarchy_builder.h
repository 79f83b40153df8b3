#pragma once

#include <cstdint>
#include <string>

#include "hlod/build/simplifier.h"
#include "hlod/core/progress.h"
#include "hlod/scene/triangle_mesh.h"
#include "hlod/tree/hierarchy.h"

namespace hlodbench {

struct BuildOptions {
  std::uint32_t maxTriangles = 2000;  // a cell is split above it; what interior LODs aim at
  std::string simplifier{kDefaultSimplifier};
  unsigned threads = 0;                // 0 = one a core; does not change the result
  std::uint32_t errorSamples = 16384;  // random face points a node, besides all its vertices
};

// The options that decide the result, as one line: "max_triangles=2000 simplifier=openmesh
// error_samples=16384".
std::string canonicalOptions(const BuildOptions& options);

// What came of it, and what had to be done. Counts over interior nodes add up over the nodes.
struct BuildReport {
  std::uint64_t nodes = 0;
  std::uint64_t leaves = 0;
  std::uint64_t levels = 0;
  std::uint64_t nodesAboveLimit = 0;  // interior nodes that keep more than maxTriangles
  std::uint64_t oversizedLeaves = 0;  // leaves that could not be split further
  std::uint64_t largestNode = 0;      // triangles
  std::uint64_t lockedVertices = 0;   // locked in interior nodes, so that no crack opens
  SimplifierStats simplifier;         // over all interior nodes
  double weldSeconds = 0.0;
  double octreeSeconds = 0.0;
  double simplifySeconds = 0.0;  // of all threads together
  double errorSeconds = 0.0;     // of all threads together
  double levelsSeconds = 0.0;    // wall time of both
  double assembleSeconds = 0.0;
  double totalSeconds = 0.0;
};

// Builds the hierarchy of a scene: an octree by triangle centroids whose leaves hold the original
// triangles, and interior nodes whose LODs are made bottom-up from their children's (HLOD: Erikson,
// Manocha and Baxter 2001). LOD vertices are original vertices, and those that a node shares with
// the outside stay, so any front of the tree is free of cracks. Node::error bounds the distance
// from the original surface to the node's LOD, not the reverse (see computeNodeError()).
// report is overwritten; progress is called from this thread only. Equal input and options give
// equal bytes, whatever the number of threads.
// Throws InputError for a mesh without triangles or area, a vertex that is not finite, an index out
// of range, an unknown simplifier, or options.maxTriangles below 16.
Hierarchy buildHierarchy(const TriangleMesh& mesh, const BuildOptions& options, BuildReport& report,
                         const Progress& progress = {});

}  // namespace hlodbench
