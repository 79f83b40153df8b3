#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "hlod/build/built_tree.h"
#include "hlod/build/cell_codes.h"
#include "hlod/build/lod_maker.h"
#include "hlod/build/winding.h"
#include "hlod/tree/node_sink.h"

namespace hlodbench {

// What all chunks are built with; kept by reference.
struct ChunkContext {
  const CellCodes& codes;
  double normalScale = 1.0;
  const SharedVertices& shared;
  const Simplifier& simplifier;
  LodOptions options;
  WindingCheck& winding;
  NodeSink& sink;
  std::atomic<NodeId>& nextSinkId;
};

// What is left of a chunk when its geometry has gone to the sink.
struct BuiltChunk {
  std::vector<BuiltNode> nodes;  // breadth-first, links and levels within the chunk, the root first
  std::vector<std::pair<NodeId, std::uint32_t>> leafObjects;  // which objects a leaf has
  std::vector<std::uint64_t> sharedEdges;                     // for WindingCheck::finish()
  std::vector<std::uint8_t> turned;                           // one a node: Lod::turned
  std::uint64_t oversizedLeaves = 0;
  // The root's LOD, over its own vertices.
  WeldedMesh mesh;
  Lod root;
};

// Builds the part of the hierarchy that lies in one chunk: everything from the leaves to its root.
// triangles: in any order, which does not change the result. chunk: its number.
BuiltChunk buildChunk(std::vector<SceneTriangle> triangles, std::uint32_t chunk,
                      const ChunkContext& context, LodWorker& worker);

// Hands a node's LOD to the sink, its vertices in the order of first use, and notes their numbers.
// cell: the node where the mesh's tree has it.
void sendGeometry(const WeldedMesh& mesh, std::span<const glm::uvec3> triangles,
                  const OctreeNode& cell, const ChunkContext& context, LodWorker& worker,
                  BuiltNode& node);

}  // namespace hlodbench
