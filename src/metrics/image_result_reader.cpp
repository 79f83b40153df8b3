// The reading half of image_result.h.

#include <fmt/format.h>

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

}  // namespace

std::optional<StoredImageSummaries> readImageSummaries(const std::filesystem::path& resultFolder) {
  const std::filesystem::path path = resultFolder / kImageFolder / kImageFileName;
  if (!std::filesystem::exists(path)) return std::nullopt;
  const nlohmann::json json = parseJson(readTextFile(path), path.string());
  const JsonView view(json, path.string());
  const JsonView version = view.at("schema_version");
  const std::string major = std::string(kImageSchemaVersion).substr(0, 2);
  if (version.text().substr(0, major.size()) != major)
    version.fail(fmt::format("a version {}x (this program writes {})", major, kImageSchemaVersion),
                 version.text());
  StoredImageSummaries stored;
  stored.frames = view.at("frames").size();
  stored.complete = view.at("complete").boolean();
  const JsonView strategies = view.at("strategies");
  for (std::size_t i = 0; i < strategies.size(); ++i)
    stored.strategies[strategies.item(i).at("strategy").text()] =
        readSummary(strategies.item(i).at("summary"));
  return stored;
}

}  // namespace hlodbench
