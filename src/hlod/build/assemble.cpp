#include "hlod/build/assemble.h"

#include <cmath>

#include "hlod/build/local_index.h"
#include "hlod/core/parallel_for.h"

namespace hlodbench {
namespace {

std::int16_t packNormal(float value) {
  return static_cast<std::int16_t>(std::lround(glm::clamp(value, -1.0f, 1.0f) * 32767.0f));
}

std::uint8_t packColor(float value) {
  return static_cast<std::uint8_t>(std::lround(glm::clamp(value, 0.0f, 1.0f) * 255.0f));
}

Vertex packVertex(const WeldedMesh& mesh, std::uint32_t v,
                  const std::vector<SceneObject>& objects) {
  Vertex out;
  out.position = mesh.positions[v];
  for (int axis = 0; axis < 3; ++axis) out.normal[axis] = packNormal(mesh.normals[v][axis]);
  const std::uint32_t object = mesh.objects[v];
  out.object = static_cast<std::uint16_t>(object & 0xffffu);
  for (int channel = 0; channel < 3; ++channel)
    out.color[channel] = packColor(objects[object].color[channel]);
  out.color[3] = 255;
  return out;
}

void numberVertices(std::span<const glm::uvec3> triangles, LocalIndex& local) {
  local.reset();
  for (const glm::uvec3& t : triangles)
    for (int corner = 0; corner < 3; ++corner) local.add(t[corner]);
}

}  // namespace

std::span<const glm::uvec3> lodTriangles(const WeldedMesh& mesh, const OctreeNode& node,
                                         const NodeLod& lod) {
  if (node.isLeaf()) return std::span(mesh.triangles).subspan(node.begin, node.size());
  return lod.triangles;
}

Hierarchy assembleHierarchy(const WeldedMesh& mesh, const Octree& tree,
                            const std::vector<NodeLod>& lods,
                            const std::vector<SceneObject>& objects, unsigned threads) {
  Hierarchy out;
  out.objects = objects;
  out.inputTriangles = mesh.triangles.size();
  out.nodes.resize(tree.nodes.size());
  std::vector<LocalIndex> scratch(threads);
  parallelFor(tree.nodes.size(), threads, [&](std::size_t i, unsigned worker) {
    const OctreeNode& from = tree.nodes[i];
    const auto triangles = lodTriangles(mesh, from, lods[i]);
    numberVertices(triangles, scratch[worker]);
    Node& node = out.nodes[i];
    node.box = from.box;
    node.error = lods[i].error;
    node.parent = from.parent;
    node.firstChild = from.firstChild;
    node.childCount = from.childCount;
    node.level = from.level;
    node.vertexCount = static_cast<std::uint32_t>(scratch[worker].vertices().size());
    node.indexCount = static_cast<std::uint32_t>(triangles.size() * 3);
  });
  std::uint64_t vertices = 0;
  std::uint64_t indices = 0;
  for (Node& node : out.nodes) {
    node.firstVertex = vertices;
    node.firstIndex = indices;
    vertices += node.vertexCount;
    indices += node.indexCount;
  }
  out.vertices.resize(vertices);
  out.indices.resize(indices);
  parallelFor(tree.nodes.size(), threads, [&](std::size_t i, unsigned worker) {
    const Node& node = out.nodes[i];
    LocalIndex& local = scratch[worker];
    local.reset();
    std::uint64_t index = node.firstIndex;
    for (const glm::uvec3& t : lodTriangles(mesh, tree.nodes[i], lods[i]))
      for (int corner = 0; corner < 3; ++corner) out.indices[index++] = local.add(t[corner]);
    for (std::uint32_t v = 0; v < node.vertexCount; ++v)
      out.vertices[node.firstVertex + v] = packVertex(mesh, local.vertices()[v], objects);
  });
  return out;
}

}  // namespace hlodbench
