#include "hlod/build/hierarchy_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "hlod/build/chunk_budget.h"
#include "hlod/build/scene_pass.h"
#include "hlod/build/stop_watch.h"
#include "hlod/build/top_builder.h"
#include "hlod/core/error.h"

namespace hlodbench {
namespace {

// Counts up whenever equal options come to make other nodes, so that hierarchies of older programs
// are built anew.
constexpr int kBuilderRevision = 2;

// The box of all triangles.
Aabb measureScene(const TriangleSource& source, unsigned threads) {
  if (source.triangleCount() == 0)
    throw InputError("mesh: expected at least one triangle, found none");
  if (source.triangleCount() >= std::numeric_limits<std::uint32_t>::max())
    throw InputError(fmt::format("mesh: expected fewer than {} triangles, found {}",
                                 std::numeric_limits<std::uint32_t>::max(),
                                 source.triangleCount()));
  std::vector<Aabb> boxes(threads);
  std::atomic<bool> hasArea{false};
  passOverScene(source, threads, [&](std::span<const SceneTriangle> triangles, unsigned worker) {
    for (const SceneTriangle& t : triangles)
      for (const glm::vec3& corner : t.corners) boxes[worker].extend(corner);
    hasArea = hasArea || std::any_of(triangles.begin(), triangles.end(), [](const auto& t) {
                const glm::dvec3 cross = scaledCross(t, 1.0);
                return cross != glm::dvec3(0.0);
              });
  });
  if (!hasArea) throw InputError("mesh: expected triangles with an area, found none");
  Aabb box;
  for (const Aabb& part : boxes) box.extend(part);
  return box;
}

// Puts every triangle into its chunk and finds the chunks' boxes.
std::vector<Aabb> sortIntoChunks(const TriangleSource& source, const CellCodes& codes,
                                 const ChunkPlan& plan, unsigned threads, ChunkStore& store,
                                 const std::function<void(double)>& report) {
  std::vector<std::vector<Aabb>> parts(threads, std::vector<Aabb>(plan.chunks.size()));
  passOverScene(
      source, threads,
      [&](std::span<const SceneTriangle> triangles, unsigned worker) {
        std::uint32_t chunk = 0;
        for (const SceneTriangle& t : triangles) {
          plan.find(codes.codeOf(t), chunk);
          for (const glm::vec3& corner : t.corners) parts[worker][chunk].extend(corner);
          store.add(t, chunk, worker);
        }
      },
      report);
  store.finish();
  std::vector<Aabb> boxes(plan.chunks.size());
  for (const std::vector<Aabb>& part : parts)
    for (std::size_t chunk = 0; chunk < boxes.size(); ++chunk) boxes[chunk].extend(part[chunk]);
  return boxes;
}

// The stages of building, one after the other.
class TreeBuilder {
 public:
  // The options are kept by reference.
  TreeBuilder(const TriangleSource& source, const BuildOptions& options, NodeSink& sink,
              BuildReport& report, const Progress& progress)
      : source_(source),
        options_(options),
        sink_(sink),
        report_(report),
        progress_(progress),
        threads_(resolveThreads(options.threads)),
        simplifier_(createSimplifier(options.simplifier)),
        workers_(threads_),
        winding_(source.objects().size()) {}

  BuiltTree run() {
    StopWatch total, watch;
    const ChunkBudget budget = computeChunkBudget(source_, options_, threads_);
    tell("measuring", 0.0);
    const Aabb box = measureScene(source_, threads_);
    const CellCodes codes(box);
    tell("counting", 0.0);
    const ChunkPlan plan =
        computeChunkPlan(source_, codes, budget.chunkTriangles, threads_, teller("counting"));
    std::optional<std::filesystem::path> folder;
    if (options_.memory > 0) folder = options_.temporaryFolder;
    ChunkStore store(plan, threads_, folder);
    const std::vector<Aabb> boxes =
        sortIntoChunks(source_, codes, plan, threads_, store, teller("sorting"));
    report_.sortSeconds = watch.lap();
    tell("sharing", 0.0);
    const double scale = normalScale(box);
    const SharedVertices shared = findSharedVertices(store, boxes, scale, threads_);
    report_.sharedSeconds = watch.lap();
    const ChunkContext context{codes,        scale,    shared, *simplifier_,
                               lodOptions(), winding_, sink_,  nextSinkId_};
    std::vector<BuiltChunk> chunks = buildChunks(plan, store, context);
    report_.chunkSeconds = watch.lap();
    std::vector<std::uint8_t> turned;
    const std::vector<BuiltNode> top = buildTop(plan, chunks, context, workers_, turned);
    BuiltTree tree = joinTree(plan, top, turned, chunks, winding_);
    tree.objects = source_.objects();
    tree.inputTriangles = source_.triangleCount();
    report_.topSeconds = watch.lap();
    count(tree, chunks);
    report_.totalSeconds = total.lap();
    tell("simplify", 1.0);
    return tree;
  }

 private:
  void tell(const char* stage, double share) const {
    if (progress_) progress_(stage, share);
  }
  [[nodiscard]] std::function<void(double)> teller(const char* stage) const {
    return [this, stage](double share) { tell(stage, share); };
  }
  [[nodiscard]] LodOptions lodOptions() const {
    return {options_.maxTriangles, options_.errorSamples, options_.exactTriangles, options_.error,
            options_.normals};
  }

  std::vector<BuiltChunk> buildChunks(const ChunkPlan& plan, ChunkStore& store,
                                      const ChunkContext& context) {
    // The largest first, so that the last ones end together.
    std::vector<std::uint32_t> order(plan.chunks.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return store.size(a) > store.size(b);
    });
    std::vector<BuiltChunk> chunks(order.size());
    std::atomic<std::uint64_t> done{0};
    parallelFor(
        order.size(), threads_,
        [&](std::size_t i, unsigned worker) {
          const std::uint32_t chunk = order[i];
          const std::uint64_t triangles = store.size(chunk);
          chunks[chunk] = buildChunk(store.take(chunk), chunk, context, workers_[worker]);
          done += triangles;
        },
        [&](std::size_t) {
          tell("simplify",
               static_cast<double>(done) / static_cast<double>(source_.triangleCount()));
        });
    std::vector<std::uint64_t> edges;
    for (BuiltChunk& chunk : chunks) {
      edges.insert(edges.end(), chunk.sharedEdges.begin(), chunk.sharedEdges.end());
      std::vector<std::uint64_t>().swap(chunk.sharedEdges);
    }
    winding_.finish(std::move(edges), context.shared.vertices);
    return chunks;
  }

  void count(const BuiltTree& tree, const std::vector<BuiltChunk>& chunks) {
    report_.nodes = tree.nodes.size();
    report_.chunks = chunks.size();
    for (const BuiltNode& node : tree.nodes) {
      const std::uint32_t triangles = node.indexCount / 3;
      report_.levels = std::max<std::uint64_t>(report_.levels, node.level + 1);
      report_.largestNode = std::max<std::uint64_t>(report_.largestNode, triangles);
      if (node.childCount == 0)
        ++report_.leaves;
      else if (triangles > options_.maxTriangles)
        ++report_.nodesAboveLimit;
    }
    for (const BuiltChunk& chunk : chunks) report_.oversizedLeaves += chunk.oversizedLeaves;
    for (const LodWorker& worker : workers_) {
      report_.simplifier.add(worker.stats);
      report_.lockedVertices += worker.lockedVertices;
      report_.simplifySeconds += worker.simplifySeconds;
      report_.errorSeconds += worker.errorSeconds;
    }
  }

  const TriangleSource& source_;
  const BuildOptions& options_;
  NodeSink& sink_;
  BuildReport& report_;
  const Progress& progress_;
  unsigned threads_;
  std::unique_ptr<Simplifier> simplifier_;
  std::vector<LodWorker> workers_;
  WindingCheck winding_;
  std::atomic<NodeId> nextSinkId_{0};
};

BuildOptions adaptToParts(const TriangleSource& source, BuildOptions options, double& smallPart) {
  if (!options.adaptToParts) return options;
  const double size = source.computePartSize();
  if (size >= kSmallPart) return options;
  smallPart = size;
  options.maxTriangles = kSmallPart;
  options.simplifier = kDefaultSimplifier;
  return options;
}

}  // namespace

std::string canonicalOptions(const BuildOptions& options) {
  return fmt::format(
      "builder={} max_triangles={} simplifier={} error_samples={} error={} normals={}{}",
      kBuilderRevision, options.maxTriangles, options.simplifier, options.errorSamples,
      options.error == ErrorMeasure::kRms ? "rms" : "max",
      options.normals == LodNormals::kSmoothed ? "smoothed" : "original",
      options.adaptToParts ? " adapt=parts" : "");
}

BuiltTree buildTree(const TriangleSource& source, const BuildOptions& options, NodeSink& sink,
                    BuildReport& report, const Progress& progress) {
  constexpr std::uint32_t kLeastTriangles = 16;
  if (options.maxTriangles < kLeastTriangles)
    throw InputError(fmt::format("build: max_triangles: expected at least {}, found {}",
                                 kLeastTriangles, options.maxTriangles));
  if (source.objects().size() > kMaxObjects)
    throw InputError(fmt::format("build: expected at most {} objects, found {}", kMaxObjects,
                                 source.objects().size()));
  report = BuildReport();
  const BuildOptions adapted = adaptToParts(source, options, report.smallPartSize);
  return TreeBuilder(source, adapted, sink, report, progress).run();
}

}  // namespace hlodbench
