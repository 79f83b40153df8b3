#include "table_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace hlodbench {
namespace {

constexpr const char* kDash = "–";
constexpr const char* kUnknown = "n/a";

std::string formatFixed(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : kUnknown;
}

std::string formatCounter(const TableRow& row, Counter counter, const std::optional<double>& value,
                          int digits) {
  return isDashInPaper(row.strategy, counter) ? kDash : formatFixed(value, digits);
}

std::string formatPaper(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : kDash;
}

std::string formatSpeedup(const TableRow& row) {
  if (row.strategy == kReferenceStrategy) return kDash;
  if (!row.speedup) return kUnknown;
  const MedianInterval& interval = row.speedup->interval;
  if (!interval.low || !interval.high) return fmt::format("{:.2f}", interval.median);
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", interval.median, *interval.low, *interval.high);
}

std::string formatLimitShare(const TableRow& row) {
  if (row.strategy == kLimitStrategy) return kDash;
  if (!row.limitShare) return kUnknown;
  const MedianInterval& interval = row.limitShare->interval;
  const std::string median = fmt::format("{:.1f} %", 100.0 * interval.median);
  if (!interval.low || !interval.high) return median;
  return fmt::format("{} [{:.1f}, {:.1f}]", median, 100.0 * *interval.low, 100.0 * *interval.high);
}

std::vector<std::string> computeOurCells(const TableRow& row) {
  return {row.label,
          "this run",
          formatFixed(row.dn, 1),
          formatCounter(row, Counter::kRarn, row.rarn, 2),
          formatCounter(row, Counter::kD, row.d, 2),
          formatFixed(row.fps, 1),
          formatFixed(row.fpsFrameMean, 1),
          formatSpeedup(row)};
}

std::vector<std::string> computePaperCells(const PaperRow& row, const PaperScene& scene,
                                           bool sameScene) {
  return {row.label,
          (sameScene ? "paper, " : "other: paper's ") + scene.label,
          formatPaper(row.dn),
          formatPaper(row.rarn),
          formatPaper(row.d),
          fmt::format("{:.1f}", row.fps),
          "",
          row.speedup ? fmt::format("{:.2f}", *row.speedup) : kDash};
}

TableGrid computeCostGrid(const TableBlock& block) {
  TableGrid grid;
  grid.header = {"Scenario", "Values", "DN", "RARN", "D", "FPS", "frame FPS", "Speedup [95 %]"};
  const bool hasLimit = block.hasLimit();
  if (hasLimit) grid.header.emplace_back("of Oracle's FPS");
  for (const TableRow& row : block.rows) {
    grid.groupStarts.push_back(grid.rows.size());
    grid.rows.push_back(computeOurCells(row));
    if (hasLimit) grid.rows.back().push_back(formatLimitShare(row));
    for (const PaperScene* scene : block.papers)
      if (const PaperRow* paper = scene->find(row.strategy)) {
        grid.rows.push_back(computePaperCells(*paper, *scene, block.sameScene));
        grid.rows.back().resize(grid.header.size());
      }
  }
  return grid;
}

std::string formatCount(double count) {
  if (count >= 1e6) return fmt::format("{:.2f}M", count / 1e6);
  if (count >= 1e4) return fmt::format("{:.0f}k", count / 1e3);
  return fmt::format("{:.0f}", count);
}

std::string formatRatio(double value, bool isShare) {
  return isShare ? fmt::format("{:.2f} %", 100.0 * value) : fmt::format("{:.3f}", value);
}

std::string computeRatioLine(const TableBlock& block) {
  std::string scenes;
  for (const PaperScene* scene : block.papers)
    scenes += (scenes.empty() ? "" : "; ") + scene->label;
  std::string line = fmt::format("Ratios of DN, in brackets the paper's ({}):", scenes);
  const char* separator = " ";
  for (const TableRatio& ratio : computeTableRatios(block)) {
    std::string papers;
    for (const double value : ratio.papers)
      papers += (papers.empty() ? "" : "; ") + formatRatio(value, ratio.isShare);
    line += fmt::format("{}{} {} ({})", separator, ratio.label,
                        ratio.ours ? formatRatio(*ratio.ours, ratio.isShare) : kUnknown, papers);
    separator = ", ";
  }
  return line;
}

// Empty for results without stage times.
std::string computeStageLine(const TableBlock& block) {
  std::string line;
  for (const TableRow& row : block.rows)
    if (row.traversalUsPerVisit && row.queryUsPerVisit)
      line += fmt::format("{}{} {:.2f} + {:.2f}", line.empty() ? "" : ", ", row.label,
                          *row.traversalUsPerVisit, *row.queryUsPerVisit);
  return line.empty() ? line : "microseconds a visited node, traversal + query handling: " + line;
}

std::string computeMachineLine(const TableBlock& block) {
  const Environment& environment = block.run.environment;
  return fmt::format("{}: {} ({}, {}), {}, {}, {}", block.folder.string(), environment.program,
                     environment.gitRevision.value_or("no revision"), environment.buildType,
                     environment.cpuModel.value_or("unknown processor"),
                     environment.gl.renderer.empty() ? "no OpenGL" : environment.gl.renderer,
                     environment.timeUtc);
}

// "Coh(B) repetition 2, 3; SW(B) repetition 3", repetitions counted from 0 as in the file names.
std::string computeMissingList(const TableBlock& block) {
  std::vector<std::pair<std::string, std::string>> lists;
  for (const CaseKey& key : block.run.missing) {
    const TableRow* row = block.find(key.strategy);
    const std::string label = row ? row->label : tableLabel(key.strategy, key.strategy);
    const auto found = std::find_if(lists.begin(), lists.end(),
                                    [&](const auto& list) { return list.first == label; });
    if (found == lists.end())
      lists.emplace_back(label, fmt::format("{}", key.repetition));
    else
      found->second += fmt::format(", {}", key.repetition);
  }
  std::string text;
  for (const auto& [label, repetitions] : lists)
    text += fmt::format("{}{} repetition {}", text.empty() ? "" : "; ", label, repetitions);
  return text.empty() ? "not known what" : text;
}

std::vector<std::string> computeBlockNotes(const TableBlock& block) {
  std::vector<std::string> notes;
  if (!block.sameScene)
    notes.push_back(
        fmt::format("\"{}\" is not a scene of the paper: the paper's values are for "
                    "orientation only",
                    block.run.scene.name));
  if (std::string stages = computeStageLine(block); !stages.empty())
    notes.push_back(std::move(stages));
  for (const CaseResult& result : block.run.cases)
    if (result.error)
      notes.push_back(fmt::format("{} repetition {} failed: {}",
                                  tableLabel(result.key.strategy, result.label),
                                  result.key.repetition, *result.error));
  if (!block.run.complete) notes.push_back("incomplete run, missing: " + computeMissingList(block));
  for (const std::string& warning : block.run.warnings) notes.push_back("warning: " + warning);
  return notes;
}

}  // namespace

TableText computeTableText(const TableBlock& block) {
  TableText text;
  const RunResult& run = block.run;
  text.title = fmt::format("{}: {} triangles, {} nodes; session {}, {} frames, {} repetitions",
                           run.scene.name, formatCount(static_cast<double>(run.scene.triangles)),
                           formatCount(static_cast<double>(run.scene.nodes)), run.session.name,
                           run.session.frames, run.repetitions);
  text.machine = computeMachineLine(block);
  text.costs = computeCostGrid(block);
  text.hasLimit = block.hasLimit();
  text.ratios = computeRatioLine(block);
  text.why = computeWhyGrid(block);
  text.whyCaption = computeWhyCaption(block);
  text.quality = computeQualityGrid(block);
  text.qualityCaption = computeQualityCaption(block);
  text.notes = computeBlockNotes(block);
  return text;
}

std::vector<std::string> computeTableNotes(const std::vector<TableBlock>& blocks) {
  int fewest = blocks.front().run.warmUpFrames;
  int most = fewest;
  bool hasSimp = false;
  bool hasLimit = false;
  for (const TableBlock& block : blocks) {
    fewest = std::min(fewest, block.run.warmUpFrames);
    most = std::max(most, block.run.warmUpFrames);
    hasSimp = hasSimp || block.find("simp-b") != nullptr;
    hasLimit = hasLimit || block.hasLimit();
  }
  const std::string warmUp =
      fewest == most ? fmt::format("{}", most) : fmt::format("{} to {}", fewest, most);
  std::vector<std::string> notes{
      fmt::format("Averages over all frames and repetitions. Warm-up frames before each repetition "
                  "are excluded; there were {}.",
                  warmUp),
      "FPS: frames over total time. frame FPS: mean of the FPS of single frames. The paper does "
      "not say which of the two it prints.",
      "Speedup: of Coh(B) over the row, median over repetitions of the FPS ratio within a "
      "repetition, with its 95 % bootstrap interval.",
      "Paper: " + paperTable1().citation};
  if (hasLimit)
    notes.push_back(
        "of Oracle's FPS: of the row's FPS over Oracle's, which draws the recorded front of SW(B) "
        "and does nothing else; median and interval as for Speedup. See docs/limits.md.");
  if (hasSimp) notes.push_back("* reconstruction, see docs/deviations.md; not the authors' method");
  return notes;
}

}  // namespace hlodbench
