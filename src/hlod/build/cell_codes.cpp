#include "hlod/build/cell_codes.h"

#include <algorithm>
#include <bit>

namespace hlodbench {
namespace {

constexpr double kCells = 1u << kMaxOctreeDepth;

std::uint64_t spreadBits(std::uint32_t value) {
  std::uint64_t x = value & 0x1fffffu;
  x = (x | x << 32) & 0x1f00000000ffffu;
  x = (x | x << 16) & 0x1f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  x = (x | x << 2) & 0x1249249249249249u;
  return x;
}

// A flat scene would be cut all through by the first of the planes that halve the root cell across
// its short side. So it lies in the middle of the smallest cell that is as high as it: only cells
// of about its height are cut there.
double firstCellAround(double extent, double size) {
  double cell = size;
  for (unsigned cuts = 0; cuts < kMaxOctreeDepth && extent <= 0.5 * cell; ++cuts) cell *= 0.5;
  return cell;
}

}  // namespace

CellCodes::CellCodes(const Aabb& box) {
  const glm::dvec3 low(box.min);
  const glm::dvec3 high(box.max);
  const glm::dvec3 extent = high - low;
  const double size = std::max({extent.x, extent.y, extent.z});
  for (int axis = 0; axis < 3; ++axis)
    corner_[axis] = 0.5 * (low[axis] + high[axis] - firstCellAround(extent[axis], size));
  scale_ = kCells / size;
}

std::uint64_t CellCodes::codeOf(const SceneTriangle& triangle) const {
  const glm::dvec3 centroid = (glm::dvec3(triangle.corners[0]) + glm::dvec3(triangle.corners[1]) +
                               glm::dvec3(triangle.corners[2])) /
                              3.0;
  const glm::dvec3 cell = glm::clamp((centroid - corner_) * scale_, 0.0, kCells - 1.0);
  return spreadBits(static_cast<std::uint32_t>(cell.x)) << 2 |
         spreadBits(static_cast<std::uint32_t>(cell.y)) << 1 |
         spreadBits(static_cast<std::uint32_t>(cell.z));
}

unsigned commonDepth(std::uint64_t a, std::uint64_t b) {
  if (a == b) return kMaxOctreeDepth;
  const unsigned highestBit = 63u - static_cast<unsigned>(std::countl_zero(a ^ b));
  return kMaxOctreeDepth - 1 - highestBit / 3;
}

}  // namespace hlodbench
