#include "metrics/image_compare.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace hlodbench {
namespace {

template <typename A, typename B>
void checkSameSize(const A& a, const B& b) {
  if (a.width != b.width || a.height != b.height)
    throw std::invalid_argument("pictures of different size cannot be compared");
}

constexpr double kDepthJump = 4.0;  // pixels' size

// 1 for each pixel of an outline of what is seen.
std::vector<std::uint8_t> findOutline(const DepthImage& image, double pixelSize) {
  std::vector<std::uint8_t> outline(image.depth.size(), 0);
  const auto width = static_cast<std::size_t>(image.width);
  const auto compare = [&](std::size_t a, std::size_t b) {
    const float nearer = std::min(image.depth[a], image.depth[b]);
    const float farther = std::max(image.depth[a], image.depth[b]);
    // false for two infinite ones, which are background anyway
    if (farther - nearer > kDepthJump * pixelSize * nearer) outline[a] = outline[b] = 1;
  };
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    if (std::isinf(image.depth[i])) outline[i] = 1;
    if (i % width + 1 < width) compare(i, i + 1);
    if (i + width < image.depth.size()) compare(i, i + width);
  }
  return outline;
}

bool isNear(const std::vector<std::uint8_t>& outline, int width, int height, int x, int y,
            int margin) {
  for (int v = std::max(0, y - margin); v <= std::min(height - 1, y + margin); ++v)
    for (int u = std::max(0, x - margin); u <= std::min(width - 1, x + margin); ++u)
      if (outline[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(u)] != 0)
        return true;
  return false;
}

}  // namespace

std::uint64_t countCoveredPixels(const Image& image) {
  std::uint64_t covered = 0;
  for (std::size_t i = 0; i < image.pixelCount(); ++i) covered += image.isCovered(i) ? 1 : 0;
  return covered;
}

std::uint64_t countWrongPixels(const Image& test, const Image& reference) {
  checkSameSize(test, reference);
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < reference.pixelCount(); ++i) {
    if (!reference.isCovered(i)) continue;
    const std::uint8_t* a = &test.pixels[4 * i];
    const std::uint8_t* b = &reference.pixels[4 * i];
    if (!std::equal(a, a + 4, b)) ++wrong;
  }
  return wrong;
}

std::uint64_t countCrackPixels(const Image& test, const DepthImage& full, double pixelSize,
                               int margin) {
  checkSameSize(test, full);
  const std::vector<std::uint8_t> outline = findOutline(full, pixelSize);
  std::uint64_t cracks = 0;
  for (std::size_t i = 0; i < test.pixelCount(); ++i) {
    const auto x = static_cast<int>(i % static_cast<std::size_t>(test.width));
    const auto y = static_cast<int>(i / static_cast<std::size_t>(test.width));
    if (!test.isCovered(i) && !isNear(outline, test.width, test.height, x, y, margin)) ++cracks;
  }
  return cracks;
}

}  // namespace hlodbench
