#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "hlod/build/built_tree.h"
#include "hlod/build/lod_normals.h"
#include "hlod/build/node_error.h"
#include "hlod/build/simplifier.h"
#include "hlod/core/progress.h"
#include "hlod/scene/triangle_source.h"
#include "hlod/tree/hierarchy.h"
#include "hlod/tree/node_sink.h"

namespace hlodbench {

// Triangles; the paper's nodes.
inline constexpr std::uint32_t kSmallPart = 2000;

struct BuildOptions {
  std::uint32_t maxTriangles = 2000;  // a cell is split above it; what interior LODs aim at
  std::string simplifier{kDefaultSimplifier};
  unsigned threads = 0;                // 0 = one a core; does not change the result
  std::uint32_t errorSamples = 16384;  // points a node, see computeNodeError()
  ErrorMeasure error = ErrorMeasure::kLargest;
  LodNormals normals = LodNormals::kOriginal;
  // Scenes whose connected parts have fewer than kSmallPart triangles on the average are built with
  // nodes of that size and the default simplifier, whatever stands above.
  bool adaptToParts = false;

  // How the work is cut up; does not change the result either. Bytes that building may take, about;
  // 0: no limit. Under a limit, triangles wait in a temporary file in `temporaryFolder`.
  std::uint64_t memory = 0;
  std::filesystem::path temporaryFolder = ".";
  std::uint64_t chunkTriangles = 0;  // built at a time; 0: chosen by their number and `memory`

  // Errors of nodes of more triangles are measured from samples of their surface. For tests; chunks
  // are not made smaller than this.
  std::uint64_t exactTriangles = 16384;
};

// What decides the result, as one line: "builder=2 max_triangles=2000 simplifier=openmesh
// error_samples=16384 error=max normals=original", and " adapt=parts" where that is asked for.
std::string canonicalOptions(const BuildOptions& options);

// What came of it, and what had to be done. Counts over interior nodes add up over the nodes.
struct BuildReport {
  double smallPartSize = 0.0;  // triangles a part, where options were adapted to it; else 0
  std::uint64_t nodes = 0;
  std::uint64_t leaves = 0;
  std::uint64_t levels = 0;
  std::uint64_t chunks = 0;
  std::uint64_t nodesAboveLimit = 0;  // interior nodes that keep more than maxTriangles
  std::uint64_t oversizedLeaves = 0;  // leaves that could not be split further
  std::uint64_t largestNode = 0;      // triangles
  std::uint64_t lockedVertices = 0;   // locked in interior nodes, so that no crack opens
  SimplifierStats simplifier;         // over all interior nodes
  double sortSeconds = 0.0;           // until every triangle is in its chunk
  double sharedSeconds = 0.0;         // finding vertices that chunks share
  double simplifySeconds = 0.0;       // of all threads together
  double errorSeconds = 0.0;          // of all threads together
  double chunkSeconds = 0.0;          // wall time of building the chunks
  double topSeconds = 0.0;            // wall time of building what lies above them
  double totalSeconds = 0.0;
};

// Builds the hierarchy of a scene: an octree by triangle centroids whose leaves hold the original
// triangles, and interior nodes whose LODs are made bottom-up from their children's (HLOD: Erikson,
// Manocha and Baxter 2001). LOD vertices are original vertices, and those that a node shares with
// the outside stay, so any front of the tree is free of cracks. Node::error is of the distance from
// the original surface to the node's LOD, not the reverse: a bound of it, or its root mean square.
// The scene is cut into chunks, nodes of the tree that are built one by one, several at a time; a
// node's geometry goes to the sink as soon as it is made. Equal triangles, in whatever order, and
// equal options make equal nodes, whatever the number of threads and the memory.
// report is overwritten; progress is called from this thread only.
// Throws InputError for a scene without triangles or area, a vertex that is not finite, an unknown
// simplifier, options.maxTriangles below 16, a memory limit that is too small, or a temporary file
// that cannot be written.
BuiltTree buildTree(const TriangleSource& source, const BuildOptions& options, NodeSink& sink,
                    BuildReport& report, const Progress& progress = {});

// The same in memory.
Hierarchy buildHierarchy(const TriangleSource& source, const BuildOptions& options,
                         BuildReport& report, const Progress& progress = {});

// Throws InputError besides for an index out of range.
Hierarchy buildHierarchy(const TriangleMesh& mesh, const BuildOptions& options, BuildReport& report,
                         const Progress& progress = {});

}  // namespace hlodbench
