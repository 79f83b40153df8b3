#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hlod/build/local_index.h"
#include "hlod/build/lod_normals.h"
#include "hlod/build/node_error.h"
#include "hlod/build/octree.h"
#include "hlod/build/simplifier.h"
#include "hlod/build/surface_samples.h"
#include "hlod/build/welded_mesh.h"

namespace hlodbench {

// What is known of one node's LOD.
struct Lod {
  std::vector<glm::uvec3> triangles;  // over the mesh's vertices; empty where a leaf's are a range
  float error = 0.0f;                 // world units
  bool original = false;              // its triangles are the scene's own
  bool turned = false;                // a face of it, or of one below, was turned over
  std::optional<SurfaceSamples> samples;
};

// Decides what LODs are like.
struct LodOptions {
  std::uint32_t maxTriangles;    // what they aim at
  std::uint32_t errorSamples;    // see computeNodeError()
  std::uint64_t exactTriangles;  // errors of nodes of more triangles are measured from samples
  ErrorMeasure error;
  LodNormals normals;
};

// What one thread counts, and the memory it keeps between nodes.
struct LodWorker {
  LocalIndex local;
  VertexNotes notes;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  SimplifierStats stats;
  std::uint64_t lockedVertices = 0;
  double simplifySeconds = 0.0;
  double errorSeconds = 0.0;
};

// Makes LODs of the inner nodes of a tree from their children's. The leaves are those of a chunk,
// which hold ranges of its triangles, or the chunks themselves in the top of a large tree.
class LodMaker {
 public:
  // All kept by reference; `lods` has one a node, those of the leaves filled.
  LodMaker(const WeldedMesh& mesh, const std::vector<OctreeNode>& tree, std::vector<Lod>& lods,
           const Simplifier& simplifier, const LodOptions& options)
      : mesh_(mesh), tree_(tree), lods_(lods), simplifier_(simplifier), options_(options) {}

  // Makes the LOD of an inner node whose children's LODs are there. Several threads may do so for
  // different nodes.
  void make(NodeId id, LodWorker& worker) const;

  // Makes sure that the node's samples are there.
  void needSamples(NodeId id) const;

  // The LOD's triangles of any node, leaf or not.
  [[nodiscard]] std::span<const glm::uvec3> triangles(NodeId id) const;

 private:
  void simplifyChildren(const OctreeNode& node, Lod& lod, LodWorker& worker) const;
  [[nodiscard]] std::size_t targetTriangles(std::size_t lockedVertices) const;
  [[nodiscard]] std::span<const glm::uvec3> originals(const OctreeNode& node) const;

  const WeldedMesh& mesh_;
  const std::vector<OctreeNode>& tree_;
  std::vector<Lod>& lods_;
  const Simplifier& simplifier_;
  LodOptions options_;
};

}  // namespace hlodbench
