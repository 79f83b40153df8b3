#include "hlod/build/lod_maker.h"

#include <algorithm>

#include "hlod/build/node_frame.h"
#include "hlod/build/stop_watch.h"

namespace hlodbench {

void LodMaker::make(NodeId id, LodWorker& worker) const {
  const OctreeNode& node = tree_[id];
  Lod& lod = lods_[id];
  StopWatch watch;
  simplifyChildren(node, lod, worker);
  worker.simplifySeconds += watch.lap();
  LodSurface surface{mesh_, lod.triangles, node.box, 0.0f};
  for (NodeId child = node.firstChild; child < node.firstChild + node.childCount; ++child)
    surface.childError = std::max(surface.childError, lods_[child].error);
  if (options_.error == ErrorMeasure::kRms) {
    needSamples(id);
    lod.error = computeRmsError(surface, *lod.samples);
  } else if (node.triangles <= options_.exactTriangles) {
    lod.error = computeNodeError(surface, originals(node), options_.errorSamples, worker.notes);
  } else {
    needSamples(id);
    lod.error = computeNodeError(surface, *lod.samples);
  }
  // Nobody asks for the children's any more.
  for (NodeId child = node.firstChild; child < node.firstChild + node.childCount; ++child) {
    std::vector<glm::uvec3>().swap(lods_[child].triangles);
    lods_[child].samples.reset();
  }
  worker.errorSeconds += watch.lap();
}

void LodMaker::needSamples(NodeId id) const {
  const OctreeNode& node = tree_[id];
  Lod& lod = lods_[id];
  if (lod.samples) return;
  if (node.triangles <= options_.exactTriangles || node.isLeaf()) {
    lod.samples = takeSamples(mesh_, originals(node), options_.errorSamples / 2);
    return;
  }
  std::vector<const SurfaceSamples*> sets;
  for (NodeId child = node.firstChild; child < node.firstChild + node.childCount; ++child) {
    needSamples(child);
    sets.push_back(&*lods_[child].samples);
  }
  lod.samples = joinSamples(sets, options_.errorSamples / 2);
}

std::span<const glm::uvec3> LodMaker::triangles(NodeId id) const {
  const bool isRange = tree_[id].isLeaf() && lods_[id].triangles.empty();
  return isRange ? originals(tree_[id]) : std::span<const glm::uvec3>(lods_[id].triangles);
}

std::span<const glm::uvec3> LodMaker::originals(const OctreeNode& node) const {
  return std::span(mesh_.triangles).subspan(node.begin, node.end - node.begin);
}

void LodMaker::simplifyChildren(const OctreeNode& node, Lod& lod, LodWorker& worker) const {
  worker.local.reset();
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint8_t> origins;
  for (std::uint32_t i = 0; i < node.childCount; ++i) {
    const NodeId child = node.firstChild + i;
    for (const glm::uvec3& t : this->triangles(child))
      triangles.emplace_back(worker.local.add(t.x), worker.local.add(t.y), worker.local.add(t.z));
    const Lod& childLod = lods_[child];
    lod.turned = lod.turned || childLod.turned;
    origins.resize(triangles.size(),
                   childLod.original ? static_cast<std::uint8_t>(i) : kNotOriginal);
  }
  const std::vector<std::uint32_t>& vertices = worker.local.vertices();
  const NodeFrame frame(node.box);
  std::vector<glm::vec3> positions(vertices.size());
  std::vector<std::uint8_t> locked(vertices.size());
  std::size_t lockedVertices = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    positions[v] = frame.toLocal(mesh_.positions[vertices[v]]);
    locked[v] = mesh_.isLocked(vertices[v], node.begin, node.end) ? 1 : 0;
    lockedVertices += locked[v];
  }
  worker.lockedVertices += lockedVertices;
  SimplifierStats stats;
  lod.triangles = simplifier_.simplify(
      {positions, triangles, locked, origins, targetTriangles(lockedVertices)}, stats);
  lod.turned = lod.turned || stats.flippedFaces + stats.foldedFaces > 0;
  worker.stats.add(stats);
  // A node of nothing but degenerate triangles keeps one: every node has something to draw.
  if (lod.triangles.empty()) lod.triangles.push_back(triangles.front());
  for (glm::uvec3& t : lod.triangles) t = {vertices[t.x], vertices[t.y], vertices[t.z]};
}

// A surface with L vertices on its border and I inside has about L + 2 I triangles. Where locked
// vertices alone would use up the limit, the inside still gets half of it: held to the limit, the
// surface would collapse to its border.
std::size_t LodMaker::targetTriangles(std::size_t lockedVertices) const {
  const std::size_t limit = options_.maxTriangles;
  return std::max(limit, lockedVertices + limit / 2);
}

}  // namespace hlodbench
