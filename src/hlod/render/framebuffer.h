#pragma once

#include <cstdint>
#include <vector>

#include "hlod/render/gl_object.h"

namespace hlodbench {

// 8-bit RGBA, rows from the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // 4 * width * height
};

// Off-screen colour (RGBA8) and depth (24 bits), without multisampling: SAMPLES_PASSED counts
// pixels.
class Framebuffer {
 public:
  // Throws std::runtime_error when the driver refuses the size.
  Framebuffer(int width, int height);

  void bind() const;
  [[nodiscard]] Image readColor() const;
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  int width_, height_;
  GlFramebuffer framebuffer_;
  GlRenderbuffer color_, depth_;
};

}  // namespace hlodbench
