#include "hlod/build/assemble.h"

#include <fmt/format.h>

#include "hlod/build/local_index.h"
#include "hlod/core/error.h"
#include "hlod/core/parallel_for.h"
#include "hlod/tree/memory_sink.h"
#include "hlod/tree/octahedral.h"

namespace hlodbench {
namespace {

Node makeNode(const OctreeNode& from, const NodeLod& lod) {
  Node node;
  node.box = from.box;
  node.error = lod.error;
  node.parent = from.parent;
  node.firstChild = from.firstChild;
  node.childCount = from.childCount;
  node.level = from.level;
  return node;
}

}  // namespace

std::span<const glm::uvec3> lodTriangles(const WeldedMesh& mesh, const OctreeNode& node,
                                         const NodeLod& lod) {
  if (node.isLeaf()) return std::span(mesh.triangles).subspan(node.begin, node.size());
  return lod.triangles;
}

Vertex packVertex(const WeldedMesh& mesh, std::uint32_t v) {
  const OctahedralNormal normal = encodeOctahedral(mesh.normals[v]);
  return {mesh.positions[v], {normal[0], normal[1]}, static_cast<std::uint16_t>(mesh.objects[v])};
}

void checkObjectCount(std::size_t objects) {
  if (objects > kMaxObjects)
    throw InputError(
        fmt::format("build: expected at most {} objects, found {}", kMaxObjects, objects));
}

void sendGeometry(const WeldedMesh& mesh, const Octree& tree, const std::vector<NodeLod>& lods,
                  unsigned threads, NodeSink& sink) {
  struct Scratch {
    LocalIndex local;
    std::vector<std::uint32_t> indices;
    std::vector<Vertex> vertices;
  };
  std::vector<Scratch> scratch(threads);
  parallelFor(tree.nodes.size(), threads, [&](std::size_t i, unsigned worker) {
    auto& [local, indices, vertices] = scratch[worker];
    local.reset();
    indices.clear();
    vertices.clear();
    for (const glm::uvec3& t : lodTriangles(mesh, tree.nodes[i], lods[i]))
      for (int corner = 0; corner < 3; ++corner) indices.push_back(local.add(t[corner]));
    for (const std::uint32_t v : local.vertices()) vertices.push_back(packVertex(mesh, v));
    sink.addGeometry(static_cast<NodeId>(i), vertices, indices);
  });
}

Hierarchy assembleHierarchy(const WeldedMesh& mesh, const Octree& tree,
                            const std::vector<NodeLod>& lods,
                            const std::vector<SceneObject>& objects, unsigned threads) {
  checkObjectCount(objects.size());
  Hierarchy out;
  out.objects = objects;
  out.inputTriangles = mesh.triangles.size();
  out.nodes.reserve(tree.nodes.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i)
    out.nodes.push_back(makeNode(tree.nodes[i], lods[i]));
  MemorySink sink;
  sendGeometry(mesh, tree, lods, threads, sink);
  sink.finish(out);
  return out;
}

}  // namespace hlodbench
