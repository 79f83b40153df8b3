#include "metrics/image_result.h"

#include <algorithm>

#include "metrics/json_or_null.h"
#include "metrics/summary.h"
#include "metrics/text_file.h"

namespace hlodbench {
namespace {

using Json = nlohmann::ordered_json;

ComponentSummary summarise(const std::vector<std::optional<double>>& values) {
  std::vector<double> finite;
  for (const auto& value : values)
    if (value) finite.push_back(*value);
  ComponentSummary summary;
  summary.count = finite.size();
  summary.identical = values.size() - finite.size();
  if (!finite.empty()) summary.mean = computeMean(finite);
  if (finite.size() > 1) summary.stddev = computeStddev(finite, *summary.mean);
  return summary;
}

PsnrSummary summarise(const std::vector<ComponentPsnr>& frames) {
  std::vector<std::optional<double>> y, cb, cr;
  for (const ComponentPsnr& psnr : frames) {
    y.push_back(psnr.y);
    cb.push_back(psnr.cb);
    cr.push_back(psnr.cr);
  }
  return {summarise(y), summarise(cb), summarise(cr)};
}

Json toJson(const ComponentPsnr& psnr) {
  return {{"y", orNull(psnr.y)}, {"cb", orNull(psnr.cb)}, {"cr", orNull(psnr.cr)}};
}

Json toJson(const ComponentSummary& summary) {
  return {{"mean", orNull(summary.mean)},
          {"stddev", orNull(summary.stddev)},
          {"count", summary.count},
          {"identical", summary.identical}};
}

Json toJson(const PsnrSummary& summary) {
  return {{"y", toJson(summary.y)}, {"cb", toJson(summary.cb)}, {"cr", toJson(summary.cr)}};
}

Json toJson(const ImageSummary& summary) {
  return {{"vs_reference", summary.vsReference ? toJson(*summary.vsReference) : Json(nullptr)},
          {"vs_full", toJson(summary.vsFull)},
          {"wrong_share",
           {{"mean", orNull(summary.wrongShareMean)}, {"max", orNull(summary.wrongShareMax)}}},
          {"crack_pixels", summary.crackPixels}};
}

Json toJson(const PictureFrame& frame) {
  Json overlays = Json::object();
  for (const auto& [name, file] : frame.overlays) overlays[name] = file;
  return {{"frame", frame.frame},
          {"file", frame.file},
          {"overlays", std::move(overlays)},
          {"rarn_nodes", frame.rarnNodes},
          {"vs_reference", frame.vsReference ? toJson(*frame.vsReference) : Json(nullptr)},
          {"vs_full", toJson(frame.vsFull)},
          {"wrong_pixels", frame.wrongPixels},
          {"crack_pixels", frame.crackPixels}};
}

Json toJson(const StrategyPictures& pictures) {
  Json frames = Json::array();
  for (const PictureFrame& frame : pictures.frames) frames.push_back(toJson(frame));
  return {{"strategy", pictures.strategy},
          {"label", pictures.label},
          {"frames", std::move(frames)},
          {"summary", toJson(computeImageSummary(pictures.frames))}};
}

}  // namespace

ImageSummary computeImageSummary(const std::vector<PictureFrame>& frames) {
  ImageSummary summary;
  std::vector<ComponentPsnr> vsReference, vsFull;
  double share = 0.0;
  double largest = 0.0;
  std::size_t covered = 0;
  for (const PictureFrame& frame : frames) {
    if (frame.vsReference) vsReference.push_back(*frame.vsReference);
    vsFull.push_back(frame.vsFull);
    summary.crackPixels += frame.crackPixels;
    if (frame.coveredPixels == 0) continue;
    ++covered;
    const double here =
        static_cast<double>(frame.wrongPixels) / static_cast<double>(frame.coveredPixels);
    share += here;
    largest = std::max(largest, here);
  }
  if (!vsReference.empty()) summary.vsReference = summarise(vsReference);
  summary.vsFull = summarise(vsFull);
  if (covered > 0) {
    summary.wrongShareMean = share / static_cast<double>(covered);
    summary.wrongShareMax = largest;
  }
  return summary;
}

nlohmann::ordered_json toJson(const ImageResult& result) {
  Json full = Json::array();
  for (const FullPicture& picture : result.full)
    full.push_back({{"frame", picture.frame},
                    {"file", picture.file},
                    {"covered_pixels", picture.coveredPixels}});
  Json strategies = Json::array();
  for (const StrategyPictures& pictures : result.strategies) strategies.push_back(toJson(pictures));
  return {{"schema_version", kImageSchemaVersion},
          {"selection", result.selection},
          {"seed", result.seed},
          {"frames", result.frames},
          {"format", result.format},
          {"width", result.width},
          {"height", result.height},
          {"color_matrix", kColorMatrix},
          {"crack_margin", result.crackMargin},
          {"reference", orNull(result.reference)},
          {"complete", result.complete},
          {"overlays", result.overlays},
          {"full", std::move(full)},
          {"strategies", std::move(strategies)}};
}

void writeImageResult(const std::filesystem::path& folder, const ImageResult& result) {
  writeTextFile(folder / kImageFileName,
                toJson(result).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace hlodbench
