// The reading half of image_result.h.

#include <fmt/format.h>

#include <limits>

#include "metrics/image_result.h"
#include "metrics/json_view.h"
#include "metrics/text_file.h"

namespace hlodbench {
namespace {

std::optional<double> readNumber(const JsonView& view, std::string_view key) {
  const auto value = view.find(key);
  return value ? std::optional(value->number()) : std::nullopt;
}

ComponentSummary readComponent(const JsonView& view) {
  return {readNumber(view, "mean"), readNumber(view, "stddev"),
          static_cast<std::size_t>(view.at("count").integer()),
          static_cast<std::size_t>(view.at("identical").integer())};
}

PsnrSummary readPsnr(const JsonView& view) {
  return {readComponent(view.at("y")), readComponent(view.at("cb")), readComponent(view.at("cr"))};
}

ImageSummary readSummary(const JsonView& view) {
  ImageSummary summary;
  if (const auto psnr = view.find("vs_reference")) summary.vsReference = readPsnr(*psnr);
  summary.vsFull = readPsnr(view.at("vs_full"));
  summary.wrongShareMean = readNumber(view.at("wrong_share"), "mean");
  summary.wrongShareMax = readNumber(view.at("wrong_share"), "max");
  summary.crackPixels = static_cast<std::uint64_t>(view.at("crack_pixels").integer());
  return summary;
}

int readInt(const JsonView& view) {
  return static_cast<int>(view.integer(0, std::numeric_limits<int>::max()));
}

ComponentPsnr readFramePsnr(const JsonView& view) {
  return {readNumber(view, "y"), readNumber(view, "cb"), readNumber(view, "cr")};
}

PictureFrame readFrame(const JsonView& view) {
  PictureFrame frame;
  frame.frame = readInt(view.at("frame"));
  frame.file = view.at("file").text();
  if (const auto overlays = view.find("overlays"))
    for (const auto& [name, file] : overlays->object().items())
      frame.overlays[name] = overlays->at(name).text();
  frame.rarnNodes = readInt(view.at("rarn_nodes"));
  if (const auto psnr = view.find("vs_reference")) frame.vsReference = readFramePsnr(*psnr);
  frame.vsFull = readFramePsnr(view.at("vs_full"));
  frame.wrongPixels = static_cast<std::uint64_t>(view.at("wrong_pixels").integer());
  frame.crackPixels = static_cast<std::uint64_t>(view.at("crack_pixels").integer());
  return frame;
}

// The file's content, of a version that this program knows; the JSON must outlive the view.
JsonView openImageResult(const std::filesystem::path& path, nlohmann::json& json) {
  json = parseJson(readTextFile(path), path.string());
  JsonView view(json, path.string());
  const JsonView version = view.at("schema_version");
  const std::string major = std::string(kImageSchemaVersion).substr(0, 2);
  if (version.text().substr(0, major.size()) != major)
    version.fail(fmt::format("a version {}x (this program writes {})", major, kImageSchemaVersion),
                 version.text());
  return view;
}

}  // namespace

std::optional<StoredImageSummaries> readImageSummaries(const std::filesystem::path& resultFolder) {
  const std::filesystem::path path = resultFolder / kImageFolder / kImageFileName;
  if (!std::filesystem::exists(path)) return std::nullopt;
  nlohmann::json json;
  const JsonView view = openImageResult(path, json);
  StoredImageSummaries stored;
  stored.frames = view.at("frames").size();
  stored.complete = view.at("complete").boolean();
  const JsonView strategies = view.at("strategies");
  for (std::size_t i = 0; i < strategies.size(); ++i)
    stored.strategies[strategies.item(i).at("strategy").text()] =
        readSummary(strategies.item(i).at("summary"));
  return stored;
}

std::optional<ImageResult> readImageResult(const std::filesystem::path& resultFolder) {
  const std::filesystem::path path = resultFolder / kImageFolder / kImageFileName;
  if (!std::filesystem::exists(path)) return std::nullopt;
  nlohmann::json json;
  const JsonView view = openImageResult(path, json);
  ImageResult result;
  result.selection = view.at("selection").text();
  result.seed = static_cast<std::uint64_t>(view.at("seed").integer());
  const JsonView frames = view.at("frames");
  for (std::size_t i = 0; i < frames.size(); ++i) result.frames.push_back(readInt(frames.item(i)));
  result.format = view.at("format").text();
  result.width = readInt(view.at("width"));
  result.height = readInt(view.at("height"));
  if (const auto reference = view.find("reference")) result.reference = reference->text();
  result.crackMargin = readInt(view.at("crack_margin"));
  result.complete = view.at("complete").boolean();
  const JsonView overlays = view.at("overlays");
  for (std::size_t i = 0; i < overlays.size(); ++i)
    result.overlays.push_back(overlays.item(i).text());
  std::map<int, std::uint64_t> covered;
  const JsonView full = view.at("full");
  for (std::size_t i = 0; i < full.size(); ++i) {
    const JsonView picture = full.item(i);
    result.full.push_back({readInt(picture.at("frame")), picture.at("file").text(),
                           static_cast<std::uint64_t>(picture.at("covered_pixels").integer())});
    covered[result.full.back().frame] = result.full.back().coveredPixels;
  }
  const JsonView strategies = view.at("strategies");
  for (std::size_t i = 0; i < strategies.size(); ++i) {
    const JsonView strategy = strategies.item(i);
    StrategyPictures pictures{strategy.at("strategy").text(), strategy.at("label").text(), {}};
    const JsonView shown = strategy.at("frames");
    for (std::size_t j = 0; j < shown.size(); ++j) {
      pictures.frames.push_back(readFrame(shown.item(j)));
      pictures.frames.back().coveredPixels = covered[pictures.frames.back().frame];
    }
    result.strategies.push_back(std::move(pictures));
  }
  return result;
}

}  // namespace hlodbench
