#include "visible_parts.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hlodbench {
namespace {

constexpr std::size_t kMostNumbers = std::size_t{1} << 24;

// The number that a pixel's colour stands for.
std::uint32_t readNumber(const Image& image, std::size_t pixel) {
  const std::uint8_t* p = &image.pixels[4 * pixel];
  return p[0] | static_cast<std::uint32_t>(p[1]) << 8 | static_cast<std::uint32_t>(p[2]) << 16;
}

glm::vec3 toColor(std::size_t number) {
  return glm::vec3(number & 255u, (number >> 8) & 255u, (number >> 16) & 255u) / 255.0f;
}

// Of numbers that may repeat.
std::size_t countDistinct(std::vector<std::uint64_t> numbers) {
  std::sort(numbers.begin(), numbers.end());
  return static_cast<std::size_t>(std::unique(numbers.begin(), numbers.end()) - numbers.begin());
}

}  // namespace

std::optional<VisibleParts> countVisibleParts(const Hierarchy& hierarchy, Renderer& renderer,
                                              const Camera& camera, std::span<const NodeId> nodes) {
  const auto isTooLarge = [&](NodeId id) {
    return hierarchy.node(id).triangleCount() > kMostNumbers;
  };
  if (nodes.size() > kMostNumbers || std::any_of(nodes.begin(), nodes.end(), isTooLarge))
    return std::nullopt;

  renderer.beginFrame(camera, Shading::kFlat);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    renderer.setTint(toColor(i));
    renderer.drawNodes(nodes.subspan(i, 1));
  }
  const Image places = renderer.readColor();
  renderer.beginFrame(camera, Shading::kTriangles);
  renderer.drawNodes(nodes);
  const Image triangles = renderer.readColor();

  std::vector<std::uint64_t> seenNodes, seenTriangles;
  for (std::size_t pixel = 0; pixel < places.pixelCount(); ++pixel) {
    if (!places.isCovered(pixel)) continue;
    const std::uint64_t place = readNumber(places, pixel);
    seenNodes.push_back(place);
    seenTriangles.push_back(place << 32 | readNumber(triangles, pixel));
  }
  return VisibleParts{countDistinct(std::move(seenNodes)), countDistinct(std::move(seenTriangles))};
}

}  // namespace hlodbench
