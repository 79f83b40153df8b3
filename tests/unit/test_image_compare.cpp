// PSNR against the closed form, wrong pixels, cracks.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>

#include "metrics/image_compare.h"

namespace hlodbench {
namespace {

Image makeImage(int width, int height, const std::function<void(int, int, std::uint8_t*)>& fill) {
  Image image{width, height, {}};
  image.pixels.resize(4 * image.pixelCount(), 255);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      fill(x, y, &image.pixels[4 * (static_cast<std::size_t>(y) * width + x)]);
  return image;
}

Image makeNoise(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  return makeImage(width, height, [&](int, int, std::uint8_t* p) {
    for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(random() % 256);
  });
}

// The definition, in double precision: BT.601, full range, of 255.
ComponentPsnr computeClosedForm(const Image& a, const Image& b) {
  double squares[3] = {};
  for (std::size_t i = 0; i < a.pixelCount(); ++i) {
    double d[3];
    for (int c = 0; c < 3; ++c) d[c] = double(a.pixels[4 * i + c]) - b.pixels[4 * i + c];
    const double y = 0.299 * d[0] + 0.587 * d[1] + 0.114 * d[2];
    const double planes[3] = {y, (d[2] - y) / 1.772, (d[0] - y) / 1.402};
    for (int c = 0; c < 3; ++c) squares[c] += planes[c] * planes[c];
  }
  const auto psnr = [&](int c) {
    return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(a.pixelCount()) / squares[c]);
  };
  return {psnr(0), psnr(1), psnr(2)};
}

void expectNear(const ComponentPsnr& ours, const ComponentPsnr& expected, double tolerance) {
  ASSERT_TRUE(ours.y && ours.cb && ours.cr);
  EXPECT_NEAR(*ours.y, *expected.y, tolerance);
  EXPECT_NEAR(*ours.cb, *expected.cb, tolerance);
  EXPECT_NEAR(*ours.cr, *expected.cr, tolerance);
}

TEST(Psnr, IsTheClosedFormOnNoise) {
  const Image a = makeNoise(61, 37, 1);
  const Image b = makeNoise(61, 37, 2);
  expectNear(computePsnr(a, b), computeClosedForm(a, b), 0.01);
}

// 67 dB, as the paper prints for Cb, is a few steps in a whole picture: rounding must not hide it.
TEST(Psnr, IsTheClosedFormForAFewPixels) {
  const Image a = makeNoise(640, 480, 3);
  Image b = a;
  for (std::size_t i = 0; i < 40; ++i) b.pixels[4 * (7000 * i + 11) + i % 3] ^= 8;
  const ComponentPsnr expected = computeClosedForm(a, b);
  EXPECT_GT(*expected.cb, 60.0);
  expectNear(computePsnr(a, b), expected, 0.05);
}

TEST(Psnr, IsAbsentWhereAPlaneIsIdentical) {
  const Image a = makeNoise(20, 10, 4);
  EXPECT_EQ(computePsnr(a, a), (ComponentPsnr{std::nullopt, std::nullopt, std::nullopt}));
}

TEST(Psnr, LeavesTheAlphaOut) {
  const Image a = makeNoise(20, 10, 5);
  Image b = a;
  for (std::size_t i = 3; i < b.pixels.size(); i += 4) b.pixels[i] = 0;
  EXPECT_EQ(computePsnr(a, b), ComponentPsnr());
}

TEST(Psnr, RefusesOtherSizes) {
  EXPECT_THROW(computePsnr(makeNoise(4, 6, 1), makeNoise(6, 4, 1)), std::invalid_argument);
}

Image makeObjects(const std::function<int(int, int)>& object, int width = 40, int height = 30) {
  return makeImage(width, height, [&](int x, int y, std::uint8_t* p) {
    const int index = object(x, y);
    p[0] = index < 0 ? 0 : static_cast<std::uint8_t>(index & 255);
    p[1] = index < 0 ? 0 : static_cast<std::uint8_t>(index >> 8);
    p[2] = 0;
    p[3] = index < 0 ? 0 : 255;
  });
}

TEST(WrongPixels, AreThoseOfAnotherObjectOrNone) {
  const auto scene = [](int x, int) { return x < 10 ? -1 : x < 20 ? 0 : 256; };
  const Image full = makeObjects(scene);
  EXPECT_EQ(countCoveredPixels(full), 30u * 30u);
  EXPECT_EQ(countWrongPixels(full, full), 0u);
  // another object in a column, a hole in a pixel, and one pixel that grew out of the outline
  const Image test = makeObjects([&](int x, int y) {
    if (x == 15) return 256;  // 0 and 256 differ in the high byte only
    if (x == 30 && y == 3) return -1;
    if (x == 5 && y == 5) return 0;
    return scene(x, y);
  });
  EXPECT_EQ(countWrongPixels(test, full), 30u + 1u);
}

// A disc of radius 12 before nothing, with what is cut out of it.
using Cut = std::function<bool(int, int)>;
bool isInDisc(int x, int y, double radius) {
  return std::hypot(x - 20.0, y - 15.0) < radius;
}
Image makeDisc(
    double radius, const Cut& cut = [](int, int) { return false; }) {
  return makeObjects([&](int x, int y) { return isInDisc(x, y, radius) && !cut(x, y) ? 0 : -1; });
}
constexpr double kPixelSize = 0.01;
DepthImage makeDepth(const std::function<float(int, int)>& depth) {
  DepthImage image{40, 30, {}};
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) image.depth.push_back(depth(x, y));
  return image;
}
constexpr float kNothing = std::numeric_limits<float>::infinity();
// Slanted: 2 pixels' size a pixel.
DepthImage makeDiscDepth(const Cut& cut = [](int, int) { return false; }) {
  return makeDepth([&](int x, int y) {
    return isInDisc(x, y, 12.0) && !cut(x, y) ? 10.0f + 0.2f * static_cast<float>(x - 20)
                                              : kNothing;
  });
}

TEST(Cracks, AreBackgroundInsideTheSurface) {
  EXPECT_EQ(countCrackPixels(makeDisc(12.0), makeDiscDepth(), kPixelSize, 2), 0u);
  const auto crack = [](int x, int y) { return y == 15 && x >= 19 && x <= 21; };
  EXPECT_EQ(countCrackPixels(makeDisc(12.0, crack), makeDiscDepth(), kPixelSize, 2), 3u);
  // one that reaches the outside, too: only its ends at the outline are not looked at
  const auto through = [](int, int y) { return y == 15; };
  EXPECT_GT(countCrackPixels(makeDisc(12.0, through), makeDiscDepth(), kPixelSize, 2), 15u);
}

TEST(Cracks, AreNotAnOutlineThatMoves) {
  EXPECT_EQ(countCrackPixels(makeDisc(10.5), makeDiscDepth(), kPixelSize, 2), 0u);
  EXPECT_EQ(countCrackPixels(makeDisc(13.0), makeDiscDepth(), kPixelSize, 2), 0u);
}

TEST(Cracks, AreNotWhatIsOpenInTheFullModelToo) {
  const auto window = [](int x, int y) { return std::abs(x - 20) < 2 && std::abs(y - 15) < 2; };
  EXPECT_EQ(countCrackPixels(makeDisc(12.0, window), makeDiscDepth(window), kPixelSize, 2), 0u);
}

// One part ends before another: its outline may move and leave a gap, which is no crack.
TEST(Cracks, AreNotGapsBetweenParts) {
  const DepthImage parts = makeDepth(
      [](int x, int y) { return isInDisc(x, y, 12.0) ? (x < 20 ? 10.0f : 11.0f) : kNothing; });
  const auto gap = [](int x, int y) { return x == 20 && std::abs(y - 15) < 4; };
  EXPECT_EQ(countCrackPixels(makeDisc(12.0, gap), parts, kPixelSize, 2), 0u);
  EXPECT_EQ(countCrackPixels(makeDisc(12.0, gap), makeDiscDepth(), kPixelSize, 2), 7u);
}

TEST(Cracks, RefuseOtherSizes) {
  EXPECT_THROW(countCrackPixels(makeNoise(4, 6, 1), makeDiscDepth(), kPixelSize, 2),
               std::invalid_argument);
}

}  // namespace
}  // namespace hlodbench
