#pragma once

#include <cstdint>
#include <vector>

#include "gl_fixture.h"

namespace hlodbench::testing {

// Pixels of an image, one byte each: 1 where it is set.
struct Mask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> set;

  [[nodiscard]] bool at(int x, int y) const {
    return set[static_cast<std::size_t>(y) * width + x] != 0;
  }
  [[nodiscard]] bool isInside(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height;
  }
};

inline Mask findBackground(const Image& image) {
  Mask mask{image.width, image.height, {}};
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    mask.set.push_back(image.pixels[i] == 0 ? 1 : 0);
  return mask;
}

// The background that the image's border can be reached from through background, 4-connected.
inline Mask findOuterBackground(const Mask& background) {
  Mask outer{background.width, background.height,
             std::vector<std::uint8_t>(background.set.size(), 0)};
  std::vector<std::pair<int, int>> open;
  const auto reach = [&](int x, int y) {
    if (!outer.isInside(x, y) || !background.at(x, y) || outer.at(x, y)) return;
    outer.set[static_cast<std::size_t>(y) * outer.width + x] = 1;
    open.emplace_back(x, y);
  };
  for (int x = 0; x < outer.width; ++x) {
    reach(x, 0);
    reach(x, outer.height - 1);
  }
  for (int y = 0; y < outer.height; ++y) {
    reach(0, y);
    reach(outer.width - 1, y);
  }
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    reach(x - 1, y);
    reach(x + 1, y);
    reach(x, y - 1);
    reach(x, y + 1);
  }
  return outer;
}

inline bool isNear(const Mask& mask, int x, int y, int distance) {
  for (int v = y - distance; v <= y + distance; ++v)
    for (int u = x - distance; u <= x + distance; ++u)
      if (mask.isInside(u, v) && mask.at(u, v)) return true;
  return false;
}

// Background pixels through the surface: not connected to the outside, and farther than `margin`
// pixels both from the outside (where the tip of a thin notch of the outline may be cut off by the
// pixel grid) and from everything that is background in the full-resolution image.
inline int countHoles(const Image& image, const Image& fullResolution, int margin) {
  const Mask background = findBackground(image);
  const Mask outer = findOuterBackground(background);
  const Mask full = findBackground(fullResolution);
  int holes = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (background.at(x, y) && !outer.at(x, y) && !isNear(outer, x, y, margin) &&
          !isNear(full, x, y, margin))
        ++holes;
  return holes;
}

}  // namespace hlodbench::testing
