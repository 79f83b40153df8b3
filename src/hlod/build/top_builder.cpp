#include "hlod/build/top_builder.h"

#include <algorithm>

#include "hlod/build/position_table.h"
#include "hlod/core/parallel_for.h"

namespace hlodbench {
namespace {

// One mesh of the LODs of all chunks' roots, whose triangles then name its vertices.
WeldedMesh weldRoots(std::vector<BuiltChunk>& chunks) {
  WeldedMesh mesh;
  std::size_t vertices = 0;
  for (const BuiltChunk& chunk : chunks) vertices += chunk.mesh.positions.size();
  PositionTable table(vertices);
  std::vector<std::uint8_t> unused;
  for (BuiltChunk& chunk : chunks) {
    std::vector<std::uint32_t> numbers;
    for (std::size_t v = 0; v < chunk.mesh.positions.size(); ++v) {
      numbers.push_back(table.add(chunk.mesh.positions[v], chunk.mesh.objects[v], mesh.positions,
                                  mesh.objects, unused));
      if (mesh.normals.size() == mesh.positions.size()) continue;
      mesh.normals.push_back(chunk.mesh.normals[v]);
      mesh.lockFirst.push_back(chunk.mesh.lockFirst[v]);
      mesh.lockLast.push_back(chunk.mesh.lockLast[v]);
    }
    for (glm::uvec3& t : chunk.root.triangles) t = {numbers[t.x], numbers[t.y], numbers[t.z]};
    chunk.mesh = WeldedMesh();
  }
  return mesh;
}

std::vector<OctreeNode> makeTree(const ChunkPlan& plan, const std::vector<BuiltChunk>& chunks) {
  std::vector<OctreeNode> tree(plan.nodes.size());
  for (std::size_t id = 0; id < tree.size(); ++id) {
    const TopNode& from = plan.nodes[id];
    tree[id].begin = from.firstChunk;
    tree[id].end = from.endChunk;
    tree[id].triangles = from.triangles;
    if (from.isChunk()) continue;
    // The plan adds the children of a node one after the other.
    tree[id].firstChild = from.children.front();
    tree[id].childCount = static_cast<std::uint32_t>(from.children.size());
    for (const std::uint32_t child : from.children) tree[child].level = tree[id].level + 1;
  }
  for (std::size_t id = tree.size(); id-- > 0;) {
    if (tree[id].isLeaf()) {
      tree[id].box = chunks[tree[id].begin].nodes.front().box;
    } else {
      for (const std::uint32_t child : plan.nodes[id].children)
        tree[id].box.extend(tree[child].box);
    }
  }
  return tree;
}

}  // namespace

std::vector<BuiltNode> buildTop(const ChunkPlan& plan, std::vector<BuiltChunk>& chunks,
                                const ChunkContext& context, std::vector<LodWorker>& workers,
                                std::vector<std::uint8_t>& turned) {
  std::vector<BuiltNode> out(plan.nodes.size());
  turned.assign(plan.nodes.size(), 0);
  if (chunks.size() == 1) return out;
  const WeldedMesh mesh = weldRoots(chunks);
  const std::vector<OctreeNode> tree = makeTree(plan, chunks);
  std::vector<Lod> lods(tree.size());
  for (std::size_t chunk = 0; chunk < chunks.size(); ++chunk)
    lods[plan.chunks[chunk]] = std::move(chunks[chunk].root);
  const LodMaker maker(mesh, tree, lods, context.simplifier, context.options);
  std::vector<std::vector<NodeId>> levels;
  for (NodeId id = 0; id < tree.size(); ++id) {
    if (tree[id].isLeaf()) continue;
    levels.resize(std::max<std::size_t>(levels.size(), tree[id].level + 1));
    levels[tree[id].level].push_back(id);
  }
  for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
    parallelFor(level->size(), static_cast<unsigned>(workers.size()),
                [&](std::size_t i, unsigned worker) {
                  const NodeId id = (*level)[i];
                  maker.make(id, workers[worker]);
                  BuiltNode& node = out[id];
                  node.box = tree[id].box;
                  node.error = lods[id].error;
                  node.childCount = tree[id].childCount;
                  node.sinkId = context.nextSinkId.fetch_add(1);
                  turned[id] = lods[id].turned ? 1 : 0;
                  sendGeometry(mesh, maker.triangles(id), tree[id], context, workers[worker], node);
                });
  }
  return out;
}

}  // namespace hlodbench
