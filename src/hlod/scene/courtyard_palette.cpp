#include "hlod/scene/courtyard_palette.h"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace hlodbench::courtyard {
namespace {

// sRGB colours, as 0xRRGGBB.
const std::vector<std::uint32_t>& listColors(Material material) {
  static const std::vector<std::vector<std::uint32_t>> kColors = {
      {0xd9c7a4, 0xd2bd96, 0xdccdb0},                                // wall: limestone
      {0xe6dac0, 0xdfcfb2, 0xe9e1cf, 0xd8c4a4},                      // column: paler stone
      {0xb4a891, 0xaa9f8b, 0xbdb09a},                                // paving
      {0x7f8a55, 0x768350},                                          // soil: lawn
      {0xb5694a, 0xad6045, 0xbb7454},                                // roof: terracotta
      {0x7a5a40, 0x6e5039, 0x866548},                                // timber
      {0xe8e4da, 0xdcd8cf, 0xe6d6cc, 0xcfd3d2},                      // marble
      {0x5f9384, 0x4f8379, 0xa3803f, 0x6f9a8c},                      // bronze, verdigris
      {0xc27a54, 0x3f7288, 0xd0a45a, 0x8f4f4b, 0x6b86a0, 0xa9b48c},  // ceramic
      {0x5f7f3f, 0x6f8c46, 0x4f7342, 0x86994f},                      // leaf
      {0x75604b, 0x6a5644},                                          // bark
      {0x6fa6b4, 0x7bb0ba},                                          // water
  };
  return kColors[static_cast<std::size_t>(material)];
}

float toLinear(double srgb) {
  return static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

}  // namespace

glm::vec3 pickColor(Material material, Random& random) {
  const auto& colors = listColors(material);
  const std::uint32_t color =
      colors[static_cast<std::size_t>(random.below(static_cast<int>(colors.size())))];
  const double shade = random.uniform(0.94, 1.05);
  const double warmth = random.uniform(-0.015, 0.015);
  const auto channel = [&](int shift, double offset) {
    const double value = static_cast<double>((color >> shift) & 0xffU) / 255.0;
    return toLinear(glm::clamp(value * shade + offset, 0.0, 1.0));
  };
  const float red = channel(16, warmth), green = channel(8, 0.0), blue = channel(0, -warmth);
  return {red, green, blue};
}

}  // namespace hlodbench::courtyard
