#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "metrics/image_result.h"
#include "metrics/paper_table.h"
#include "metrics/result.h"

namespace hlodbench {

// What explains a strategy's costs (--explain), means over the frames that have it.
struct ExplainedMeans {
  std::size_t frames = 0;  // that were explained
  std::optional<double> right, tooConservative, tooAggressive, needlessDelays;  // predictions
  std::optional<double> invisibleNodes, visibleTriangles, invisibleTriangles;

  // All predictions of a frame; absent where a strategy makes none.
  [[nodiscard]] std::optional<double> predictions() const {
    if (!right || !tooConservative || !tooAggressive || !needlessDelays) return std::nullopt;
    return *right + *tooConservative + *tooAggressive + *needlessDelays;
  }
};

// One strategy of one run, averaged over all measured frames of all repetitions that succeeded.
struct TableRow {
  std::string strategy;
  std::string label;            // as tables show it: "Simp*(B)" for the reconstruction
  std::size_t repetitions = 0;  // that succeeded
  std::size_t failures = 0;
  std::size_t frames = 0;  // measured, over all repetitions
  std::optional<double> dn, rarn, d;
  std::optional<double> fps;           // frames over total time
  std::optional<double> fpsFrameMean;  // mean of per-frame FPS
  std::optional<double> delayedShare;  // D over DN
  // per node taken from the priority queue, microseconds; see Counter::kTraversalMs, kQueryMs
  std::optional<double> traversalUsPerVisit, queryUsPerVisit;
  std::optional<Speedup> speedup;     // of Coh(B) over this strategy
  std::optional<Speedup> limitShare;  // of this strategy over Oracle, at most 1 but for noise
  ExplainedMeans explained;
};

// One result folder.
struct TableBlock {
  std::filesystem::path folder;
  RunResult run;
  std::optional<StoredImageSummaries> images;
  std::vector<TableRow> rows;             // the paper's order, then others by id
  std::vector<const PaperScene*> papers;  // whose values stand beside ours
  bool sameScene = false;                 // whether papers is the one scene that ours stands for

  // Whether any row has a share of Oracle's frame rate.
  [[nodiscard]] bool hasLimit() const;
  // The row of a strategy, or null.
  [[nodiscard]] const TableRow* find(const std::string& strategy) const;
  // The quality of a strategy's pictures, or null.
  [[nodiscard]] const ImageSummary* findImages(const std::string& strategy) const;
};

// A quotient the paper's text discusses: of the DN of two strategies, or D over DN of one.
struct TableRatio {
  std::string label;           // "Coh/SW", "D/DN of Coh"
  std::optional<double> ours;  // absent if a strategy was not run
  std::vector<double> papers;  // by scene, as in TableBlock::papers
  bool isShare = false;        // to be shown in per cent
};

TableBlock computeTableBlock(std::filesystem::path folder, RunResult run,
                             std::optional<StoredImageSummaries> images = std::nullopt);
std::vector<TableRatio> computeTableRatios(const TableBlock& block);

// Whether the paper prints a dash for this counter of this strategy, as it does for RARN and D
// where a strategy cannot have any. Counters other than these two never have one.
bool isDashInPaper(const std::string& strategy, Counter counter);

// The label a table shows for a strategy; `label` is what the run calls it.
std::string tableLabel(const std::string& strategy, const std::string& label);

}  // namespace hlodbench
