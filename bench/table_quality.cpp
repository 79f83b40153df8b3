// The table of picture quality.

#include <fmt/format.h>

#include "table_text.h"

namespace hlodbench {
namespace {

constexpr const char* kDash = "–";

std::string formatDb(double mean, const std::optional<double>& stddev) {
  return stddev ? fmt::format("{:.2f} ± {:.2f}", mean, *stddev) : fmt::format("{:.2f}", mean);
}

// "42.84 ± 3.22", and how many frames were identical and are not in it.
std::string formatComponent(const ComponentSummary& summary) {
  const std::string identical =
      summary.identical > 0 ? fmt::format("{} identical", summary.identical) : "";
  if (!summary.mean) return identical.empty() ? "n/a" : identical;
  const std::string text = formatDb(*summary.mean, summary.stddev);
  return identical.empty() ? text : fmt::format("{}, {}", text, identical);
}

std::string formatShare(const std::optional<double>& share) {
  return share ? fmt::format("{:.3f} %", 100.0 * *share) : "n/a";
}

std::vector<std::string> computeOurCells(const std::string& label, const ImageSummary& summary) {
  const auto& psnr = summary.vsReference;
  return {label,
          "this run",
          psnr ? formatComponent(psnr->y) : kDash,
          psnr ? formatComponent(psnr->cb) : kDash,
          psnr ? formatComponent(psnr->cr) : kDash,
          formatComponent(summary.vsFull.y),
          formatShare(summary.wrongShareMean),
          fmt::format("{}", summary.crackPixels)};
}

std::vector<std::string> computePaperCells(const std::string& label, const PaperScene& scene,
                                           bool sameScene) {
  return {label,
          (sameScene ? "paper, " : "other: paper's ") + scene.label,
          formatDb(scene.y.mean, scene.y.stddev),
          formatDb(scene.cb.mean, scene.cb.stddev),
          formatDb(scene.cr.mean, scene.cr.stddev),
          "",
          "",
          ""};
}

}  // namespace

TableGrid computeQualityGrid(const TableBlock& block) {
  TableGrid grid;
  grid.header = {"Scenario", "Values",          "Y, dB",        "Cb, dB",
                 "Cr, dB",   "Y of full model", "wrong pixels", "crack pixels"};
  for (const TableRow& row : block.rows) {
    const ImageSummary* summary = block.findImages(row.strategy);
    if (summary == nullptr) continue;
    grid.groupStarts.push_back(grid.rows.size());
    grid.rows.push_back(computeOurCells(row.label, *summary));
    if (row.strategy != kReferenceStrategy) continue;
    for (const PaperScene* scene : block.papers)
      grid.rows.push_back(computePaperCells(row.label, *scene, block.sameScene));
  }
  return grid;
}

std::string computeQualityCaption(const TableBlock& block) {
  if (!block.images) return "";
  return fmt::format(
      "PSNR against the pictures of Bool ({}; mean ± standard deviation of {} frames{}; frames "
      "with "
      "identical planes are counted apart). Against the full-resolution model: PSNR of Y, share of "
      "covered pixels that show another object, pixels of background that shine through.",
      kColorMatrix, block.images->frames, block.images->complete ? "" : ", interrupted");
}

}  // namespace hlodbench
