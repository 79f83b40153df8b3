// The table of what explains the costs.

#include <fmt/format.h>

#include <algorithm>

#include "table_text.h"

namespace hlodbench {
namespace {

constexpr const char* kNone = "n/a";

std::string formatFixed(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : kNone;
}

std::vector<std::string> computeCells(const TableRow& row) {
  const ExplainedMeans& means = row.explained;
  const std::optional<double> predictions = means.predictions();
  std::optional<double> rightPercent, trianglesPerVisible;
  if (predictions && *predictions > 0.0) rightPercent = 100.0 * *means.right / *predictions;
  if (means.visibleTriangles && means.invisibleTriangles && *means.visibleTriangles > 0.0)
    trianglesPerVisible =
        (*means.visibleTriangles + *means.invisibleTriangles) / *means.visibleTriangles;
  return {row.label,
          "this run",
          formatFixed(predictions, 1),
          rightPercent ? fmt::format("{:.1f} %", *rightPercent) : kNone,
          formatFixed(means.tooConservative, 2),
          formatFixed(means.tooAggressive, 2),
          formatFixed(means.needlessDelays, 2),
          formatFixed(means.invisibleNodes, 1),
          formatFixed(trianglesPerVisible, 2)};
}

}  // namespace

TableGrid computeWhyGrid(const TableBlock& block) {
  TableGrid grid;
  // short, for the width of a page; the caption has the words
  grid.header = {"Scenario", "Values",   "all",       "right",     "cons.",
                 "aggr.",    "needless", "invisible", "drawn/seen"};
  for (const TableRow& row : block.rows) {
    if (row.explained.frames == 0) continue;
    grid.groupStarts.push_back(grid.rows.size());
    grid.rows.push_back(computeCells(row));
  }
  return grid;
}

std::string computeWhyCaption(const TableBlock& block) {
  std::size_t frames = 0;
  for (const TableRow& row : block.rows) frames = std::max(frames, row.explained.frames);
  if (frames == 0) return "";
  return fmt::format(
      "Why, in {} frames of the first repetition. Predictions a frame, against SW(B) in the same "
      "frame: all; right; too conservative, too aggressive, needless delays. Nodes drawn of which "
      "nothing is seen; triangles drawn for one that is seen.",
      frames);
}

}  // namespace hlodbench
