// Hierarchies that are built in memory.

#include <mutex>

#include "hlod/build/hierarchy_builder.h"

namespace hlodbench {
namespace {

// Keeps every node's geometry.
class GeometryInMemory final : public NodeSink {
 public:
  void addGeometry(NodeId id, std::span<const Vertex> vertices,
                   std::span<const std::uint32_t> indices) override {
    Block block{{vertices.begin(), vertices.end()}, {indices.begin(), indices.end()}};
    const std::lock_guard lock(mutex_);
    if (id >= blocks_.size()) blocks_.resize(id + 1);
    blocks_[id] = std::move(block);
  }

  // Appends a node's geometry to the hierarchy and forgets it.
  void moveTo(Hierarchy& hierarchy, NodeId id) {
    Block& block = blocks_[id];
    hierarchy.vertices.insert(hierarchy.vertices.end(), block.vertices.begin(),
                              block.vertices.end());
    hierarchy.indices.insert(hierarchy.indices.end(), block.indices.begin(), block.indices.end());
    block = Block();
  }

 private:
  struct Block {
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
  };
  std::mutex mutex_;
  std::vector<Block> blocks_;
};

}  // namespace

Hierarchy buildHierarchy(const TriangleSource& source, const BuildOptions& options,
                         BuildReport& report, const Progress& progress) {
  GeometryInMemory geometry;
  const BuiltTree tree = buildTree(source, options, geometry, report, progress);
  Hierarchy out;
  out.objects = tree.objects;
  out.inputTriangles = tree.inputTriangles;
  std::uint64_t vertices = 0;
  std::uint64_t indices = 0;
  for (const BuiltNode& from : tree.nodes) {
    Node node;
    node.box = from.box;
    node.error = from.error;
    node.parent = from.parent;
    node.firstChild = from.firstChild;
    node.childCount = from.childCount;
    node.level = from.level;
    node.firstVertex = vertices;
    node.vertexCount = from.vertexCount;
    node.firstIndex = indices;
    node.indexCount = from.indexCount;
    vertices += from.vertexCount;
    indices += from.indexCount;
    out.nodes.push_back(node);
  }
  out.vertices.reserve(vertices);
  out.indices.reserve(indices);
  for (const BuiltNode& from : tree.nodes) geometry.moveTo(out, from.sinkId);
  return out;
}

Hierarchy buildHierarchy(const TriangleMesh& mesh, const BuildOptions& options, BuildReport& report,
                         const Progress& progress) {
  return buildHierarchy(MeshTriangles(mesh), options, report, progress);
}

}  // namespace hlodbench
