#include "hlod/build/chunk_builder.h"

#include <algorithm>
#include <cstring>

#include "hlod/build/pack_vertex.h"

namespace hlodbench {
namespace {

// Sorts triangles by their codes and, where these are equal, by what they are, so that the order
// does not depend on the order they come in. Returns the codes.
std::vector<std::uint64_t> sortTriangles(std::vector<SceneTriangle>& triangles,
                                         const CellCodes& codes) {
  struct Entry {
    std::uint64_t code;
    std::uint32_t triangle;
  };
  std::vector<Entry> order(triangles.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {codes.codeOf(triangles[i]), i};
  std::sort(order.begin(), order.end(), [&](const Entry& a, const Entry& b) {
    if (a.code != b.code) return a.code < b.code;
    return std::memcmp(&triangles[a.triangle], &triangles[b.triangle], sizeof(SceneTriangle)) < 0;
  });
  std::vector<std::uint64_t> sortedCodes(order.size());
  std::vector<SceneTriangle> sorted(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    sortedCodes[i] = order[i].code;
    sorted[i] = triangles[order[i].triangle];
  }
  triangles = std::move(sorted);
  return sortedCodes;
}

void computeBoxes(std::vector<OctreeNode>& nodes, const WeldedMesh& mesh) {
  for (std::size_t i = nodes.size(); i-- > 0;) {
    OctreeNode& node = nodes[i];
    if (node.isLeaf()) {
      for (std::uint32_t t = node.begin; t < node.end; ++t)
        for (int corner = 0; corner < 3; ++corner)
          node.box.extend(mesh.positions[mesh.triangles[t][corner]]);
    } else {
      for (NodeId child = node.firstChild; child < node.firstChild + node.childCount; ++child)
        node.box.extend(nodes[child].box);
    }
  }
}

void noteObjects(const WeldedMesh& mesh, std::span<const glm::uvec3> triangles, NodeId leaf,
                 BuiltChunk& out) {
  const std::size_t first = out.leafObjects.size();
  for (const glm::uvec3& t : triangles) {
    const std::pair<NodeId, std::uint32_t> entry{leaf, mesh.objects[t.x]};
    // Triangles of one object mostly follow each other.
    if (out.leafObjects.size() > first && out.leafObjects.back() == entry) continue;
    const auto begin = out.leafObjects.begin() + static_cast<std::ptrdiff_t>(first);
    if (std::find(begin, out.leafObjects.end(), entry) == out.leafObjects.end())
      out.leafObjects.push_back(entry);
  }
}

// Copies the root's LOD out of the chunk's mesh. Its vertices are locked from the chunk's place on,
// or by those of the chunks that share them.
void keepRoot(const WeldedMesh& mesh, std::span<const glm::uvec3> triangles, std::uint32_t chunk,
              const ChunkContext& context, std::span<const SharedPlace> places, LodWorker& worker,
              BuiltChunk& out) {
  worker.local.reset();
  std::vector<glm::uvec3> own;
  own.reserve(triangles.size());
  for (const glm::uvec3& t : triangles)
    own.emplace_back(worker.local.add(t.x), worker.local.add(t.y), worker.local.add(t.z));
  std::vector<SharedPlace> sorted(places.begin(), places.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const SharedPlace& a, const SharedPlace& b) { return a.vertex < b.vertex; });
  for (const std::uint32_t v : worker.local.vertices()) {
    out.mesh.positions.push_back(mesh.positions[v]);
    out.mesh.normals.push_back(mesh.normals[v]);
    out.mesh.objects.push_back(mesh.objects[v]);
    std::uint32_t first = chunk;
    std::uint32_t last = mesh.lockLast[v] == kLockedEverywhere ? kLockedEverywhere : chunk;
    const auto place = std::lower_bound(
        sorted.begin(), sorted.end(), v,
        [](const SharedPlace& p, std::uint32_t vertex) { return p.vertex < vertex; });
    if (place != sorted.end() && place->vertex == v) {
      const SharedVertex& shared = context.shared.vertices[place->shared];
      first = shared.firstChunk;
      last = shared.seam ? kLockedEverywhere : shared.lastChunk;
    }
    out.mesh.lockFirst.push_back(first);
    out.mesh.lockLast.push_back(last);
  }
  out.root.triangles = std::move(own);
}

}  // namespace

void sendGeometry(const WeldedMesh& mesh, std::span<const glm::uvec3> triangles,
                  const OctreeNode& cell, const ChunkContext& context, LodWorker& worker,
                  BuiltNode& node) {
  worker.local.reset();
  std::vector<std::uint32_t>& indices = worker.indices;
  indices.clear();
  for (const glm::uvec3& t : triangles)
    for (int corner = 0; corner < 3; ++corner) indices.push_back(worker.local.add(t[corner]));
  std::vector<Vertex>& vertices = worker.vertices;
  vertices.clear();
  for (const std::uint32_t v : worker.local.vertices())
    vertices.push_back(packVertex(mesh.positions[v], mesh.normals[v], mesh.objects[v]));
  if (!cell.isLeaf() && context.options.normals == LodNormals::kSmoothed) {
    const std::vector<glm::vec3> normals =
        computeSmoothedNormals(mesh, triangles, cell, worker.local);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      vertices[i] = packVertex(vertices[i].position, normals[i], vertices[i].object);
  }
  node.vertexCount = static_cast<std::uint32_t>(vertices.size());
  node.indexCount = static_cast<std::uint32_t>(indices.size());
  context.sink.addGeometry(node.sinkId, vertices, indices);
}

BuiltChunk buildChunk(std::vector<SceneTriangle> triangles, std::uint32_t chunk,
                      const ChunkContext& context, LodWorker& worker) {
  BuiltChunk out;
  WeldedMesh mesh;
  std::vector<OctreeNode> tree;
  std::vector<SharedPlace> places;
  {
    const std::vector<std::uint64_t> codes = sortTriangles(triangles, context.codes);
    tree = computeOctree(codes, context.options.maxTriangles);
    mesh = computeWeldedMesh(triangles, context.normalScale, context.shared.vertices,
                             context.shared.ofChunk[chunk], &places);
    std::vector<SceneTriangle>().swap(triangles);
  }
  computeBoxes(tree, mesh);
  out.sharedEdges = context.winding.addChunk(mesh, places);
  std::vector<Lod> lods(tree.size());
  const LodMaker maker(mesh, tree, lods, context.simplifier, context.options);
  const NodeId firstSinkId = context.nextSinkId.fetch_add(static_cast<NodeId>(tree.size()));
  out.nodes.resize(tree.size());
  out.turned.resize(tree.size());
  for (NodeId id = static_cast<NodeId>(tree.size()); id-- > 0;) {
    if (tree[id].isLeaf()) {
      lods[id].original = true;
      noteObjects(mesh, maker.triangles(id), id, out);
      if (tree[id].triangles > context.options.maxTriangles) ++out.oversizedLeaves;
    } else {
      maker.make(id, worker);
    }
    BuiltNode& node = out.nodes[id];
    node.box = tree[id].box;
    node.error = lods[id].error;
    node.firstChild = tree[id].firstChild;
    node.childCount = tree[id].childCount;
    node.sinkId = firstSinkId + id;
    out.turned[id] = lods[id].turned ? 1 : 0;
    sendGeometry(mesh, maker.triangles(id), tree[id], context, worker, node);
  }
  if (context.shared.ofChunk.size() > 1) {
    maker.needSamples(kRoot);
    const std::span<const glm::uvec3> rootTriangles = maker.triangles(kRoot);
    keepRoot(mesh, rootTriangles, chunk, context, places, worker, out);
    out.root.samples = std::move(lods[kRoot].samples);
    out.root.error = lods[kRoot].error;
    out.root.original = lods[kRoot].original;
    out.root.turned = lods[kRoot].turned;
  }
  return out;
}

}  // namespace hlodbench
