// A table for programs to read.

#include <fmt/format.h>

#include <algorithm>

#include "csv_text.h"
#include "table_text.h"

namespace hlodbench {
namespace {

// Empty where the run has no pictures, and against Bool for Bool itself.
std::vector<std::string> computeQualityFields(const TableBlock& block, const TableRow& row) {
  std::vector<std::string> fields(11);
  const ImageSummary* summary = block.findImages(row.strategy);
  if (summary == nullptr) return fields;
  fields[0] = fmt::format("{}", block.images->frames);
  if (const auto& psnr = summary->vsReference) {
    fields[1] = formatCsvNumber(psnr->y.mean);
    fields[2] = formatCsvNumber(psnr->y.stddev);
    fields[3] = formatCsvNumber(psnr->cb.mean);
    fields[4] = formatCsvNumber(psnr->cb.stddev);
    fields[5] = formatCsvNumber(psnr->cr.mean);
    fields[6] = formatCsvNumber(psnr->cr.stddev);
    fields[7] = fmt::format("{}", psnr->y.identical);
  }
  fields[8] = formatCsvNumber(summary->vsFull.y.mean);
  fields[9] = formatCsvNumber(summary->wrongShareMean);
  fields[10] = fmt::format("{}", summary->crackPixels);
  return fields;
}

std::vector<std::string> computeLimitFields(const TableRow& row) {
  if (!row.limitShare) return std::vector<std::string>(3);
  const MedianInterval& interval = row.limitShare->interval;
  return {formatCsvNumber(interval.median), formatCsvNumber(interval.low),
          formatCsvNumber(interval.high)};
}

std::vector<std::string> computeCsvFields(const TableBlock& block, const TableRow& row) {
  // Another scene's values in these columns would invite wrong quotients: they stay empty.
  const PaperScene* scene = block.sameScene ? block.papers.front() : nullptr;
  const PaperRow* paper = scene ? scene->find(row.strategy) : nullptr;
  const auto ofPaper = [&](auto member) {
    return paper ? formatCsvNumber(std::optional<double>(paper->*member)) : std::string();
  };
  std::optional<double> median, low, high;
  if (row.speedup) {
    median = row.speedup->interval.median;
    low = row.speedup->interval.low;
    high = row.speedup->interval.high;
  }
  std::vector<std::string> fields{
      block.folder.string(),
      block.run.scene.name,
      block.run.session.name,
      row.strategy,
      row.label,
      fmt::format("{}", row.repetitions),
      fmt::format("{}", row.failures),
      fmt::format("{}", row.frames),
      block.run.complete ? "1" : "0",
      formatCsvNumber(row.dn),
      formatCsvNumber(row.rarn),
      formatCsvNumber(row.d),
      formatCsvNumber(row.fps),
      formatCsvNumber(row.fpsFrameMean),
      formatCsvNumber(median),
      formatCsvNumber(low),
      formatCsvNumber(high),
      formatCsvNumber(row.delayedShare),
      paper ? scene->label : "",
      ofPaper(&PaperRow::dn),
      ofPaper(&PaperRow::rarn),
      ofPaper(&PaperRow::d),
      ofPaper(&PaperRow::fps),
      ofPaper(&PaperRow::speedup),
      paper && row.strategy == kReferenceStrategy ? formatCsvNumber(scene->delayedShare) : ""};
  const std::vector<std::string> quality = computeQualityFields(block, row);
  fields.insert(fields.end(), quality.begin(), quality.end());
  return fields;
}

}  // namespace

std::string renderCsv(const std::vector<TableBlock>& blocks) {
  const bool hasLimit = std::any_of(blocks.begin(), blocks.end(),
                                    [](const TableBlock& block) { return block.hasLimit(); });
  std::vector<std::string> header{"folder",
                                  "scene",
                                  "session",
                                  "strategy",
                                  "label",
                                  "repetitions",
                                  "failures",
                                  "frames",
                                  "complete",
                                  "ours_dn",
                                  "ours_rarn",
                                  "ours_d",
                                  "ours_fps",
                                  "ours_fps_frame_mean",
                                  "ours_speedup",
                                  "ours_speedup_low",
                                  "ours_speedup_high",
                                  "ours_delayed_share",
                                  "paper_scene",
                                  "paper_dn",
                                  "paper_rarn",
                                  "paper_d",
                                  "paper_fps",
                                  "paper_speedup",
                                  "paper_delayed_share",
                                  "pictures",
                                  "ours_psnr_y",
                                  "ours_psnr_y_stddev",
                                  "ours_psnr_cb",
                                  "ours_psnr_cb_stddev",
                                  "ours_psnr_cr",
                                  "ours_psnr_cr_stddev",
                                  "ours_psnr_identical",
                                  "ours_psnr_full_y",
                                  "ours_wrong_share",
                                  "ours_crack_pixels"};
  if (hasLimit)
    for (const char* name : {"ours_limit_share", "ours_limit_share_low", "ours_limit_share_high"})
      header.emplace_back(name);
  std::string out = formatCsvLine(header);
  for (const TableBlock& block : blocks)
    for (const TableRow& row : block.rows) {
      std::vector<std::string> fields = computeCsvFields(block, row);
      if (hasLimit)
        for (std::string& field : computeLimitFields(row)) fields.push_back(std::move(field));
      out += formatCsvLine(fields);
    }
  return out;
}

}  // namespace hlodbench
