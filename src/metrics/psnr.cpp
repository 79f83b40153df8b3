#include <Imath/ImathMatrix.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cmath>
#include <stdexcept>

#include "metrics/image_compare.h"

namespace hlodbench {
namespace {

// BT.601: Y = 0.299 R + 0.587 G + 0.114 B, Cb = (B - Y) / 1.772, Cr = (R - Y) / 1.402. Rows are
// inputs, columns outputs; the offset of Cb and Cr is left out, as it cancels in a difference.
const Imath::M44f kRgbToYcbcr(0.299f, -0.299f / 1.772f, 0.701f / 1.402f, 0.0f,   //
                              0.587f, -0.587f / 1.772f, -0.587f / 1.402f, 0.0f,  //
                              0.114f, 0.886f / 1.772f, -0.114f / 1.402f, 0.0f,   //
                              0.0f, 0.0f, 0.0f, 1.0f);

OIIO::ImageBuf makeYcbcr(const Image& image) {
  const OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT);
  OIIO::ImageBuf rgb(spec);
  constexpr OIIO::stride_t kPixel = 4;
  rgb.set_pixels(rgb.roi(), OIIO::TypeDesc::UINT8, image.pixels.data(), kPixel);
  // made beforehand: a fresh destination would take the source's type
  OIIO::ImageBuf ycbcr(spec);
  if (!OIIO::ImageBufAlgo::colormatrixtransform(ycbcr, rgb, kRgbToYcbcr))
    throw std::runtime_error("OpenImageIO: " + ycbcr.geterror());
  return ycbcr;
}

std::optional<double> comparePlane(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b, int plane) {
  OIIO::ROI roi = a.roi();
  roi.chbegin = plane;
  roi.chend = plane + 1;
  const double psnr = OIIO::ImageBufAlgo::compare(a, b, 0.0f, 0.0f, roi).PSNR;
  return std::isfinite(psnr) ? std::optional(psnr) : std::nullopt;
}

}  // namespace

ComponentPsnr computePsnr(const Image& test, const Image& reference) {
  if (test.width != reference.width || test.height != reference.height)
    throw std::invalid_argument("computePsnr: pictures of different size");
  const OIIO::ImageBuf a = makeYcbcr(test);
  const OIIO::ImageBuf b = makeYcbcr(reference);
  return {comparePlane(a, b, 0), comparePlane(a, b, 1), comparePlane(a, b, 2)};
}

}  // namespace hlodbench
