#include "hlod/build/hierarchy_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "hlod/build/assemble.h"
#include "hlod/build/border_locks.h"
#include "hlod/build/local_index.h"
#include "hlod/build/node_error.h"
#include "hlod/build/node_frame.h"
#include "hlod/build/octree.h"
#include "hlod/core/error.h"
#include "hlod/core/parallel_for.h"

namespace hlodbench {
namespace {

// Seconds since it was made or last asked.
class StopWatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// What one thread counts, and the memory it keeps between nodes.
struct Worker {
  LocalIndex local;
  SimplifierStats stats;
  std::uint64_t lockedVertices = 0;
  double simplifySeconds = 0.0;
  double errorSeconds = 0.0;
};

// Makes the LODs of the interior nodes, the deepest level first.
class LodMaker {
 public:
  LodMaker(const WeldedMesh& mesh, const Octree& tree, const BuildOptions& options,
           unsigned threads)
      : mesh_(mesh),
        tree_(tree),
        options_(options),
        locks_(mesh),
        simplifier_(createSimplifier(options.simplifier)),
        workers_(threads),
        lods_(tree.nodes.size()) {}

  std::vector<NodeLod> run(const Progress& progress) {
    std::size_t done = 0;
    std::vector<std::vector<NodeId>> levels(tree_.levels);
    for (NodeId id = 0; id < tree_.nodes.size(); ++id)
      if (!tree_.nodes[id].isLeaf()) levels[tree_.nodes[id].level].push_back(id);
    const std::size_t interior = tree_.nodes.size() - tree_.leaves;
    for (auto level = levels.rbegin(); level != levels.rend(); ++level) {
      parallelFor(
          level->size(), static_cast<unsigned>(workers_.size()),
          [&](std::size_t i, unsigned worker) { makeLod((*level)[i], workers_[worker]); },
          [&](std::size_t finished) {
            if (progress)
              progress("simplify",
                       static_cast<double>(done + finished) / static_cast<double>(interior));
          });
      done += level->size();
    }
    return std::move(lods_);
  }

  void addTo(BuildReport& report) const {
    for (const Worker& worker : workers_) {
      report.simplifier.add(worker.stats);
      report.lockedVertices += worker.lockedVertices;
      report.simplifySeconds += worker.simplifySeconds;
      report.errorSeconds += worker.errorSeconds;
    }
  }

 private:
  void makeLod(NodeId id, Worker& worker) {
    const OctreeNode& node = tree_.nodes[id];
    NodeLod& lod = lods_[id];
    StopWatch watch;
    lod.triangles = simplifyChildren(node, worker);
    worker.simplifySeconds += watch.lap();
    float childError = 0.0f;
    for (std::uint32_t child = 0; child < node.childCount; ++child)
      childError = std::max(childError, lods_[node.firstChild + child].error);
    lod.error =
        computeNodeError(mesh_, locks_, node, lod.triangles, options_.errorSamples, childError);
    worker.errorSeconds += watch.lap();
  }

  std::vector<glm::uvec3> simplifyChildren(const OctreeNode& node, Worker& worker) const {
    worker.local.reset();
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint8_t> origins;
    for (std::uint32_t i = 0; i < node.childCount; ++i) {
      const NodeId child = node.firstChild + i;
      for (const glm::uvec3& t : lodTriangles(mesh_, tree_.nodes[child], lods_[child]))
        triangles.emplace_back(worker.local.add(t.x), worker.local.add(t.y), worker.local.add(t.z));
      origins.resize(triangles.size(),
                     tree_.nodes[child].isLeaf() ? static_cast<std::uint8_t>(i) : kNotOriginal);
    }
    const std::vector<std::uint32_t>& vertices = worker.local.vertices();
    const NodeFrame frame(node.box);
    std::vector<glm::vec3> positions(vertices.size());
    std::vector<std::uint8_t> locked(vertices.size());
    std::size_t lockedVertices = 0;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      positions[v] = frame.toLocal(mesh_.positions[vertices[v]]);
      locked[v] = locks_.isLocked(vertices[v], node.begin, node.end) ? 1 : 0;
      lockedVertices += locked[v];
    }
    worker.lockedVertices += lockedVertices;
    std::vector<glm::uvec3> result = simplifier_->simplify(
        {positions, triangles, locked, origins, targetTriangles(lockedVertices)}, worker.stats);
    // A node of nothing but degenerate triangles keeps one: every node has something to draw.
    if (result.empty()) result.push_back(triangles.front());
    for (glm::uvec3& t : result) t = {vertices[t.x], vertices[t.y], vertices[t.z]};
    return result;
  }

  // A surface with L vertices on its border and I inside has about L + 2 I triangles. Where locked
  // vertices alone would use up the limit, the inside still gets half of it: held to the limit, the
  // surface would collapse to its border.
  [[nodiscard]] std::size_t targetTriangles(std::size_t lockedVertices) const {
    const std::size_t limit = options_.maxTriangles;
    return std::max(limit, lockedVertices + limit / 2);
  }

  const WeldedMesh& mesh_;
  const Octree& tree_;
  const BuildOptions& options_;
  BorderLocks locks_;
  std::unique_ptr<Simplifier> simplifier_;
  std::vector<Worker> workers_;
  std::vector<NodeLod> lods_;
};

void countNodes(const Hierarchy& hierarchy, std::uint32_t maxTriangles, BuildReport& report) {
  for (const Node& node : hierarchy.nodes) {
    report.largestNode = std::max<std::uint64_t>(report.largestNode, node.triangleCount());
    if (!node.isLeaf() && node.triangleCount() > maxTriangles) ++report.nodesAboveLimit;
  }
}

}  // namespace

std::string canonicalOptions(const BuildOptions& options) {
  return fmt::format("max_triangles={} simplifier={} error_samples={}", options.maxTriangles,
                     options.simplifier, options.errorSamples);
}

Hierarchy buildHierarchy(const TriangleMesh& mesh, const BuildOptions& options, BuildReport& report,
                         const Progress& progress) {
  constexpr std::uint32_t kLeastTriangles = 16;
  if (options.maxTriangles < kLeastTriangles)
    throw InputError(fmt::format("build: max_triangles: expected at least {}, found {}",
                                 kLeastTriangles, options.maxTriangles));
  report = BuildReport();
  StopWatch total;
  StopWatch watch;
  if (progress) progress("weld", 0.0);
  WeldedMesh welded = computeWeldedMesh(mesh);
  report.weldSeconds = watch.lap();
  if (progress) progress("octree", 0.0);
  const Octree tree = computeOctree(welded, options.maxTriangles);
  report.octreeSeconds = watch.lap();
  report.nodes = tree.nodes.size();
  report.leaves = tree.leaves;
  report.levels = tree.levels;
  report.oversizedLeaves = tree.oversizedLeaves;
  const unsigned threads = resolveThreads(options.threads);
  std::vector<NodeLod> lods;
  {
    LodMaker maker(welded, tree, options, threads);
    lods = maker.run(progress);
    maker.addTo(report);
  }
  report.levelsSeconds = watch.lap();
  if (progress) progress("assemble", 0.0);
  Hierarchy hierarchy = assembleHierarchy(welded, tree, lods, mesh.objectTable, threads);
  countNodes(hierarchy, options.maxTriangles, report);
  report.assembleSeconds = watch.lap();
  report.totalSeconds = total.lap();
  if (progress) progress("assemble", 1.0);
  return hierarchy;
}

}  // namespace hlodbench
