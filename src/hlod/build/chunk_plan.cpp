#include "hlod/build/chunk_plan.h"

#include <algorithm>

#include "hlod/build/scene_pass.h"

namespace hlodbench {
namespace {

constexpr unsigned kFirstCuts = 7;  // counters of 8^7 cells
constexpr unsigned kMoreCuts = 4;   // and of 8^4 in each cell that is still too full

// Counts the triangles in the small cells of some large ones.
class CellCounts {
 public:
  // cells: of one depth, in increasing order.
  CellCounts(std::vector<std::uint64_t> cells, unsigned depth, unsigned cuts, unsigned threads)
      : cells_(std::move(cells)), depth_(depth), cuts_(cuts), counts_(threads) {}

  void add(std::span<const SceneTriangle> triangles, const CellCodes& codes, unsigned worker) {
    std::vector<std::uint32_t>& counts = counts_[worker];
    if (counts.empty()) counts.resize(cells_.size() << 3 * cuts_);
    for (const SceneTriangle& triangle : triangles) {
      const std::uint64_t code = codes.codeOf(triangle);
      const auto cell = std::lower_bound(cells_.begin(), cells_.end(), cellAt(code, depth_));
      if (cell == cells_.end() || *cell != cellAt(code, depth_)) continue;
      const std::uint64_t mask = (std::uint64_t{1} << 3 * cuts_) - 1;
      const auto block = static_cast<std::uint64_t>(cell - cells_.begin());
      ++counts[block << 3 * cuts_ | (cellAt(code, depth_ + cuts_) & mask)];
    }
  }

  // Makes sum() work.
  void finish() {
    sums_.assign((cells_.size() << 3 * cuts_) + 1, 0);
    for (const std::vector<std::uint32_t>& counts : counts_)
      for (std::size_t i = 0; i < counts.size(); ++i) sums_[i + 1] += counts[i];
    for (std::size_t i = 1; i < sums_.size(); ++i) sums_[i] += sums_[i - 1];
    counts_.clear();
  }

  // The triangles in a cell of any depth between the large and the small ones.
  [[nodiscard]] std::uint64_t sum(std::uint64_t cell, unsigned depth) const {
    const std::uint64_t large = cell >> 3 * (depth - depth_);
    const auto block = static_cast<std::uint64_t>(
        std::lower_bound(cells_.begin(), cells_.end(), large) - cells_.begin());
    const unsigned shift = 3 * (depth_ + cuts_ - depth);
    const std::uint64_t local = (cell - (large << 3 * (depth - depth_))) << shift;
    const std::uint64_t begin = (block << 3 * cuts_) + local;
    return sums_[begin + (std::uint64_t{1} << shift)] - sums_[begin];
  }

  [[nodiscard]] unsigned smallDepth() const { return depth_ + cuts_; }

 private:
  std::vector<std::uint64_t> cells_;
  unsigned depth_;
  unsigned cuts_;
  std::vector<std::vector<std::uint32_t>> counts_;  // one list a worker
  std::vector<std::uint64_t> sums_;
};

class Planner {
 public:
  explicit Planner(std::uint64_t chunkTriangles) : limit_(chunkTriangles) {}

  // Cuts a node as far as the counts reach; what is too full even so goes to `open`.
  void cut(std::uint32_t node, const CellCounts& counts, std::vector<std::uint32_t>& open) {
    if (plan_.nodes[node].triangles <= limit_) return;
    const std::uint64_t cell = plan_.nodes[node].cell;
    const unsigned depth = plan_.nodes[node].depth;
    if (depth == counts.smallDepth()) {
      if (depth < kMaxOctreeDepth) open.push_back(node);
      return;
    }
    std::vector<std::pair<std::uint64_t, std::uint64_t>> full;  // cell and count
    for (std::uint64_t child = cell << 3; child < (cell + 1) << 3; ++child)
      if (const std::uint64_t count = counts.sum(child, depth + 1); count > 0)
        full.emplace_back(child, count);
    if (full.size() == 1) {  // makes no node
      plan_.nodes[node].cell = full[0].first;
      plan_.nodes[node].depth = depth + 1;
      cut(node, counts, open);
      return;
    }
    std::vector<std::uint32_t> children;
    for (const auto& [child, count] : full) {
      children.push_back(add(child, depth + 1, count));
      plan_.nodes[node].children.push_back(children.back());
    }
    for (const std::uint32_t child : children) cut(child, counts, open);
  }

  std::uint32_t add(std::uint64_t cell, unsigned depth, std::uint64_t triangles) {
    TopNode node;
    node.cell = cell;
    node.depth = depth;
    node.triangles = triangles;
    plan_.nodes.push_back(node);
    return static_cast<std::uint32_t>(plan_.nodes.size() - 1);
  }

  ChunkPlan finish() {
    numberChunks(0);
    return std::move(plan_);
  }

  [[nodiscard]] const TopNode& node(std::uint32_t id) const { return plan_.nodes[id]; }

 private:
  void numberChunks(std::uint32_t id) {
    plan_.nodes[id].firstChunk = static_cast<std::uint32_t>(plan_.chunks.size());
    if (plan_.nodes[id].isChunk()) {
      plan_.chunks.push_back(id);
      const TopNode& node = plan_.nodes[id];
      plan_.firstCodes.push_back(node.cell << 3 * (kMaxOctreeDepth - node.depth));
    }
    for (std::size_t i = 0; i < plan_.nodes[id].children.size(); ++i)
      numberChunks(plan_.nodes[id].children[i]);
    plan_.nodes[id].endChunk = static_cast<std::uint32_t>(plan_.chunks.size());
  }

  std::uint64_t limit_;
  ChunkPlan plan_;
};

}  // namespace

void ChunkPlan::find(std::uint64_t code, std::uint32_t& near) const {
  const bool fits =
      firstCodes[near] <= code && (near + 1 == firstCodes.size() || code < firstCodes[near + 1]);
  if (fits) return;
  const auto after = std::upper_bound(firstCodes.begin(), firstCodes.end(), code);
  near = static_cast<std::uint32_t>(after - firstCodes.begin()) - 1;
}

ChunkPlan computeChunkPlan(const TriangleSource& source, const CellCodes& codes,
                           std::uint64_t chunkTriangles, unsigned threads,
                           const std::function<void(double)>& report) {
  Planner planner(chunkTriangles);
  std::vector<std::uint32_t> open{planner.add(0, 0, source.triangleCount())};
  if (source.triangleCount() <= chunkTriangles) open.clear();
  for (unsigned depth = 0; !open.empty();) {
    const unsigned cuts = std::min(depth == 0 ? kFirstCuts : kMoreCuts, kMaxOctreeDepth - depth);
    // All of one depth; in order because a cell's number grows with its first code.
    std::sort(open.begin(), open.end(), [&](std::uint32_t a, std::uint32_t b) {
      return planner.node(a).cell < planner.node(b).cell;
    });
    std::vector<std::uint64_t> cells;
    for (const std::uint32_t id : open) cells.push_back(planner.node(id).cell);
    CellCounts counts(std::move(cells), depth, cuts, threads);
    passOverScene(
        source, threads,
        [&](std::span<const SceneTriangle> triangles, unsigned worker) {
          counts.add(triangles, codes, worker);
        },
        depth == 0 ? report : std::function<void(double)>());
    counts.finish();
    std::vector<std::uint32_t> next;
    for (const std::uint32_t id : open) planner.cut(id, counts, next);
    open = std::move(next);
    depth += cuts;
  }
  return planner.finish();
}

}  // namespace hlodbench
