#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "hlod/core/image.h"

namespace hlodbench {

// The matrix that computePsnr() uses, as results name it. The paper does not say which it took.
inline constexpr const char* kColorMatrix = "BT.601 full range";

// Peak signal-to-noise ratio of luminance and chrominance, dB, of full range (255 in 8 bits).
// Absent: the plane is identical in both pictures, the ratio infinite.
struct ComponentPsnr {
  std::optional<double> y, cb, cr;

  bool operator==(const ComponentPsnr&) const = default;
};

// Compares two pictures of the same size as the paper does (section 5.3). The 8-bit RGB values are
// turned into floating-point planes before the matrix: rounding them again would set a floor.
// Throws std::invalid_argument when the sizes differ.
ComponentPsnr computePsnr(const Image& test, const Image& reference);

// Pixels of a picture that something was drawn to.
std::uint64_t countCoveredPixels(const Image& image);

// Both in Shading::kObjects: pixels covered in the reference whose front-most object is another in
// `test`, or none (Grundhoefer et al., the measure of image error). Throws std::invalid_argument
// when the sizes differ.
std::uint64_t countWrongPixels(const Image& test, const Image& reference);

// How far from an outline a pixel must be that is looked at for cracks, pixels: what simplification
// to an error of tau pixels may move the outline by, and one for the pixel grid.
inline int computeCrackMargin(double tau) {
  return static_cast<int>(std::ceil(tau)) + 1;
}

// Pixels of background that shine through a surface: nothing was drawn there in `test`, and in the
// full-resolution picture the pixel is farther than `margin` pixels from every outline, that is
// from background and from places where the depth jumps by more than 4 pixels' size between
// neighbours (where one part of the surface ends before another, and a moved outline may open a gap
// between them). pixelSize: what a pixel spans at distance 1. 0 for closed surfaces without cracks.
// Throws std::invalid_argument when the sizes differ.
std::uint64_t countCrackPixels(const Image& test, const DepthImage& full, double pixelSize,
                               int margin);

}  // namespace hlodbench
