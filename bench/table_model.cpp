#include "table_model.h"

#include <algorithm>

namespace hlodbench {
namespace {

// Position in the paper's table; strategies it does not have come after.
std::size_t computeRank(const std::string& strategy) {
  const std::vector<PaperRow>& rows = paperTable1().scenes.front().rows;
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const PaperRow& row) { return row.strategy == strategy; });
  return static_cast<std::size_t>(found - rows.begin());
}

// A mean over frames put together from the means of several repetitions.
struct PooledMean {
  double sum = 0.0;
  std::size_t count = 0;

  void add(double mean, std::size_t frames) {
    sum += mean * static_cast<double>(frames);
    count += frames;
  }
  [[nodiscard]] std::optional<double> mean() const {
    return count == 0 ? std::nullopt : std::optional(sum / static_cast<double>(count));
  }
};

class RowBuilder {
 public:
  explicit RowBuilder(const CaseResult& first) {
    row_.strategy = first.key.strategy;
    row_.label = tableLabel(first.key.strategy, first.label);
  }

  [[nodiscard]] const std::string& strategy() const { return row_.strategy; }

  void add(const CaseResult& result) {
    if (result.error || !result.summary) {
      ++row_.failures;
      return;
    }
    const Summary& summary = *result.summary;
    ++row_.repetitions;
    row_.frames += summary.frames;
    addCounter(summary, Counter::kDn, dn_);
    addCounter(summary, Counter::kRarn, rarn_);
    addCounter(summary, Counter::kD, d_);
    // A repetition without a valid FPS has no valid frame times either.
    if (summary.fps) addCounter(summary, Counter::kFrameMs, frameMs_);
    if (summary.fpsFrameMean && summary.get(Counter::kFrameMs))
      fps_.add(*summary.fpsFrameMean, summary.get(Counter::kFrameMs)->count);
    addCounter(summary, Counter::kNodesVisited, visited_);
    addCounter(summary, Counter::kTraversalMs, traversalMs_);
    addCounter(summary, Counter::kQueryMs, queryMs_);
    addCounter(summary, Counter::kPredictedRight, right_);
    addCounter(summary, Counter::kTooConservative, conservative_);
    addCounter(summary, Counter::kTooAggressive, aggressive_);
    addCounter(summary, Counter::kNeedlessDelays, needless_);
    addCounter(summary, Counter::kInvisibleNodes, invisibleNodes_);
    addCounter(summary, Counter::kVisibleTriangles, visibleTriangles_);
    addCounter(summary, Counter::kInvisibleTriangles, invisibleTriangles_);
    const auto& dn = summary.get(Counter::kDn);
    if (summary.delayedShare && dn) {
      drawn_ += dn->mean * static_cast<double>(dn->count);
      delayed_ += *summary.delayedShare * dn->mean * static_cast<double>(dn->count);
    }
  }

  TableRow finish() {
    row_.dn = dn_.mean();
    row_.rarn = rarn_.mean();
    row_.d = d_.mean();
    if (const auto ms = frameMs_.mean()) row_.fps = 1000.0 / *ms;
    row_.fpsFrameMean = fps_.mean();
    row_.traversalUsPerVisit = perVisit(traversalMs_);
    row_.queryUsPerVisit = perVisit(queryMs_);
    row_.explained = {std::max(right_.count, invisibleNodes_.count),
                      right_.mean(),
                      conservative_.mean(),
                      aggressive_.mean(),
                      needless_.mean(),
                      invisibleNodes_.mean(),
                      visibleTriangles_.mean(),
                      invisibleTriangles_.mean()};
    if (drawn_ > 0.0) row_.delayedShare = delayed_ / drawn_;
    return std::move(row_);
  }

 private:
  static void addCounter(const Summary& summary, Counter counter, PooledMean& mean) {
    if (const auto& values = summary.get(counter)) mean.add(values->mean, values->count);
  }

  // Microseconds of a stage per visited node.
  [[nodiscard]] std::optional<double> perVisit(const PooledMean& stageMs) const {
    const auto visited = visited_.mean();
    const auto ms = stageMs.mean();
    if (!ms || !visited || !(*visited > 0.0)) return std::nullopt;
    return 1000.0 * *ms / *visited;
  }

  TableRow row_;
  PooledMean dn_, rarn_, d_, frameMs_, fps_, visited_, traversalMs_, queryMs_;
  PooledMean right_, conservative_, aggressive_, needless_;
  PooledMean invisibleNodes_, visibleTriangles_, invisibleTriangles_;
  double drawn_ = 0.0;
  double delayed_ = 0.0;
};

std::vector<TableRow> computeRows(const RunResult& run) {
  std::vector<RowBuilder> builders;
  for (const CaseResult& result : run.cases) {
    auto found = std::find_if(builders.begin(), builders.end(), [&](const RowBuilder& builder) {
      return builder.strategy() == result.key.strategy;
    });
    if (found == builders.end()) found = builders.insert(found, RowBuilder(result));
    found->add(result);
  }
  std::vector<TableRow> rows;
  for (RowBuilder& builder : builders) rows.push_back(builder.finish());
  std::sort(rows.begin(), rows.end(), [](const TableRow& a, const TableRow& b) {
    return std::pair(computeRank(a.strategy), a.strategy) <
           std::pair(computeRank(b.strategy), b.strategy);
  });
  // From the cases rather than from the file, so that the table cannot contradict its own FPS.
  for (Speedup& speedup : computeSpeedups(run.cases))
    for (TableRow& row : rows)
      if (row.strategy == speedup.over) row.speedup = std::move(speedup);
  for (TableRow& row : rows)
    if (row.strategy != kLimitStrategy)
      row.limitShare = computeSpeedup(run.cases, row.strategy, kLimitStrategy);
  return rows;
}

TableRatio computeDnRatio(const TableBlock& block, const char* label, const char* over,
                          const char* under) {
  TableRatio ratio{label, std::nullopt, {}};
  const TableRow* above = block.find(over);
  const TableRow* below = block.find(under);
  if (above && below && above->dn && below->dn && *below->dn > 0.0)
    ratio.ours = *above->dn / *below->dn;
  for (const PaperScene* scene : block.papers)
    ratio.papers.push_back(scene->find(over)->dn / scene->find(under)->dn);
  return ratio;
}

}  // namespace

bool TableBlock::hasLimit() const {
  return std::any_of(rows.begin(), rows.end(),
                     [](const TableRow& row) { return row.limitShare.has_value(); });
}

const TableRow* TableBlock::find(const std::string& strategy) const {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const TableRow& row) { return row.strategy == strategy; });
  return found == rows.end() ? nullptr : &*found;
}

const ImageSummary* TableBlock::findImages(const std::string& strategy) const {
  if (!images) return nullptr;
  const auto found = images->strategies.find(strategy);
  return found == images->strategies.end() ? nullptr : &found->second;
}

TableBlock computeTableBlock(std::filesystem::path folder, RunResult run,
                             std::optional<StoredImageSummaries> images) {
  TableBlock block;
  block.folder = std::move(folder);
  block.run = std::move(run);
  block.images = std::move(images);
  block.rows = computeRows(block.run);
  if (const PaperScene* scene = paperTable1().find(block.run.scene.name)) {
    block.sameScene = true;
    block.papers = {scene};
  } else {
    for (const PaperScene& other : paperTable1().scenes) block.papers.push_back(&other);
  }
  return block;
}

std::vector<TableRatio> computeTableRatios(const TableBlock& block) {
  std::vector<TableRatio> ratios{computeDnRatio(block, "Coh/SW", "coh-b", "sw-b"),
                                 computeDnRatio(block, "Simp*/SW", "simp-b", "sw-b"),
                                 computeDnRatio(block, "SW/Bool", "sw-b", "bool")};
  TableRatio share{"D/DN of Coh", std::nullopt, {}, true};
  if (const TableRow* row = block.find("coh-b")) share.ours = row->delayedShare;
  for (const PaperScene* scene : block.papers) share.papers.push_back(scene->delayedShare);
  ratios.push_back(std::move(share));
  return ratios;
}

bool isDashInPaper(const std::string& strategy, Counter counter) {
  const PaperRow* row = paperTable1().scenes.front().find(strategy);
  if (!row) return false;
  return (counter == Counter::kRarn && !row->rarn) || (counter == Counter::kD && !row->d);
}

std::string tableLabel(const std::string& strategy, const std::string& label) {
  return strategy == "simp-b" ? "Simp*(B)" : label;
}

}  // namespace hlodbench
