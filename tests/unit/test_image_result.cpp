#include "metrics/image_result.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>

#include "hlod/core/error.h"
#include "metrics/text_file.h"

namespace hlodbench {
namespace {

PictureFrame makeFrame(int frame, std::optional<double> y, std::uint64_t wrong) {
  PictureFrame picture;
  picture.frame = frame;
  picture.vsReference = ComponentPsnr{y, 60.0, std::nullopt};
  picture.vsFull = {30.0 + frame, 50.0, 50.0};
  picture.coveredPixels = 1000;
  picture.wrongPixels = wrong;
  picture.crackPixels = static_cast<std::uint64_t>(frame);
  return picture;
}

TEST(ImageSummary, CountsIdenticalPlanesApart) {
  const ImageSummary summary = computeImageSummary(
      {makeFrame(0, 40.0, 0), makeFrame(1, std::nullopt, 10), makeFrame(2, 44.0, 20)});
  ASSERT_TRUE(summary.vsReference);
  const ComponentSummary& y = summary.vsReference->y;
  EXPECT_EQ(y.mean, 42.0);
  EXPECT_NEAR(*y.stddev, std::sqrt(8.0), 1e-12);
  EXPECT_EQ(y.count, 2u);
  EXPECT_EQ(y.identical, 1u);
  EXPECT_EQ(summary.vsReference->cr, (ComponentSummary{std::nullopt, std::nullopt, 0, 3}));
  EXPECT_EQ(summary.vsFull.y.mean, 31.0);
  EXPECT_NEAR(*summary.wrongShareMean, 0.01, 1e-12);
  EXPECT_NEAR(*summary.wrongShareMax, 0.02, 1e-12);
  EXPECT_EQ(summary.crackPixels, 3u);
}

TEST(ImageSummary, OfASingleFrameHasNoDeviation) {
  const ImageSummary summary = computeImageSummary({makeFrame(0, 40.0, 0)});
  EXPECT_EQ(summary.vsReference->y.mean, 40.0);
  EXPECT_FALSE(summary.vsReference->y.stddev);
}

TEST(ImageSummary, OfTheReferenceComparesWithTheFullModelOnly) {
  PictureFrame frame = makeFrame(0, 40.0, 0);
  frame.vsReference.reset();
  frame.coveredPixels = 0;  // nothing in view
  const ImageSummary summary = computeImageSummary({frame});
  EXPECT_FALSE(summary.vsReference);
  EXPECT_FALSE(summary.wrongShareMean);
}

class ImageResultFile : public testing::Test {
 protected:
  ImageResultFile()
      : folder_(std::filesystem::temp_directory_path() /
                ("hlodbench-images-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_ / kImageFolder);
  }
  ~ImageResultFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(ImageResultFile, GivesBackItsSummaries) {
  ImageResult result;
  result.frames = {3, 9};
  result.complete = true;
  result.reference = "bool";
  result.strategies = {{"coh-b", "Coh(B)", {makeFrame(3, 40.0, 5), makeFrame(9, 41.0, 7)}}};
  writeImageResult(folder_ / kImageFolder, result);
  const auto stored = readImageSummaries(folder_);
  ASSERT_TRUE(stored);
  EXPECT_EQ(stored->frames, 2u);
  EXPECT_TRUE(stored->complete);
  const ImageSummary expected = computeImageSummary(result.strategies[0].frames);
  const ImageSummary& found = stored->strategies.at("coh-b");
  EXPECT_EQ(found.vsReference, expected.vsReference);
  EXPECT_EQ(found.vsFull, expected.vsFull);
  EXPECT_EQ(found.wrongShareMean, expected.wrongShareMean);
  EXPECT_EQ(found.crackPixels, expected.crackPixels);
}

TEST_F(ImageResultFile, GivesBackEverything) {
  ImageResult result;
  result.selection = "list";
  result.seed = 7;
  result.frames = {3, 9};
  result.format = "png";
  result.width = 64;
  result.height = 48;
  result.reference = "bool";
  result.crackMargin = 2;
  result.overlays = {"bias"};
  result.full = {{3, "full.00003.png", 1000}, {9, "full.00009.png", 1000}};
  result.strategies = {{"coh-b", "Coh(B)", {makeFrame(3, 40.0, 5), makeFrame(9, 41.0, 7)}},
                       {"bool", "Bool", {makeFrame(3, std::nullopt, 5)}}};
  result.strategies[0].frames[0].overlays["bias"] = "coh-b.00003.bias.png";
  result.strategies[1].frames[0].vsReference.reset();
  writeImageResult(folder_ / kImageFolder, result);
  const auto stored = readImageResult(folder_);
  ASSERT_TRUE(stored);
  EXPECT_EQ(toJson(*stored), toJson(result));
}

TEST_F(ImageResultFile, MayBeMissing) {
  EXPECT_FALSE(readImageSummaries(folder_));
  EXPECT_FALSE(readImageResult(folder_));
}

TEST_F(ImageResultFile, OfAnotherVersionIsRefused) {
  writeTextFile(folder_ / kImageFolder / kImageFileName, R"({"schema_version": "2.0.0"})");
  try {
    readImageSummaries(folder_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("images.json: /schema_version: expected"));
  }
}

}  // namespace
}  // namespace hlodbench
