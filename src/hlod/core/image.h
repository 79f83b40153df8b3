#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hlodbench {

// 8-bit RGBA, rows from the top. Alpha is 0 where nothing was drawn.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // 4 * width * height

  [[nodiscard]] std::size_t pixelCount() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] bool isCovered(std::size_t pixel) const { return pixels[4 * pixel + 3] != 0; }
};

// How far what is seen is from the eye, along the view axis; rows from the top.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<float> depth;  // width * height, world units; infinite where nothing was drawn
};

}  // namespace hlodbench
