#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "metrics/image_compare.h"

namespace hlodbench {

// Version of images.json and of results/images.schema.json; as kResultSchemaVersion.
inline constexpr const char* kImageSchemaVersion = "1.0.0";

// Where in a result folder the pictures are, and the file that says what they show.
inline constexpr const char* kImageFolder = "images";
inline constexpr const char* kImageFileName = "images.json";

// One frame as one strategy showed it.
struct PictureFrame {
  int frame = 0;
  std::string file;                             // names are relative to the folder of the pictures
  std::map<std::string, std::string> overlays;  // by name: their files
  int rarnNodes = 0;                            // nodes rendered and then refined in this frame
  std::optional<ComponentPsnr> vsReference;     // absent for the reference itself, or without one
  ComponentPsnr vsFull;
  std::uint64_t coveredPixels = 0;  // of the full-resolution picture
  std::uint64_t wrongPixels = 0;    // of those: another object is front-most
  std::uint64_t crackPixels = 0;
};

// One component over the frames. Frames with identical planes, whose ratio is infinite, are counted
// apart and enter no mean.
struct ComponentSummary {
  std::optional<double> mean, stddev;  // dB; of the sample, absent for fewer than 1 and 2 frames
  std::size_t count = 0;               // frames with a finite ratio
  std::size_t identical = 0;

  bool operator==(const ComponentSummary&) const = default;
};

struct PsnrSummary {
  ComponentSummary y, cb, cr;

  bool operator==(const PsnrSummary&) const = default;
};

struct ImageSummary {
  std::optional<PsnrSummary> vsReference;
  PsnrSummary vsFull;
  std::optional<double> wrongShareMean, wrongShareMax;  // of covered pixels, 0 to 1
  std::uint64_t crackPixels = 0;                        // sum over the frames
};

struct StrategyPictures {
  std::string strategy, label;
  std::vector<PictureFrame> frames;
};

// The full-resolution model in one frame.
struct FullPicture {
  int frame = 0;
  std::string file;
  std::uint64_t coveredPixels = 0;
};

// Everything of the picture pass but the pictures.
struct ImageResult {
  std::string selection;  // random, all or list
  std::uint64_t seed = 0;
  std::vector<int> frames;
  std::string format;  // png or exr
  int width = 0, height = 0;
  std::optional<std::string> reference;  // the strategy that others are compared with
  int crackMargin = 0;                   // pixels, see countCrackPixels()
  bool complete = false;
  std::vector<std::string> overlays;
  std::vector<FullPicture> full;
  std::vector<StrategyPictures> strategies;
};

ImageSummary computeImageSummary(const std::vector<PictureFrame>& frames);

nlohmann::ordered_json toJson(const ImageResult& result);
// Writes images.json into the folder of the pictures. Throws InputError.
void writeImageResult(const std::filesystem::path& folder, const ImageResult& result);

// What a table needs of images.json.
struct StoredImageSummaries {
  std::size_t frames = 0;
  bool complete = false;
  std::map<std::string, ImageSummary> strategies;  // by id
};

// Read it from a result folder, or all of it; nothing when the run made no pictures. Throw
// InputError.
std::optional<StoredImageSummaries> readImageSummaries(const std::filesystem::path& resultFolder);
std::optional<ImageResult> readImageResult(const std::filesystem::path& resultFolder);

}  // namespace hlodbench
