#pragma once

#include <vector>

#include "hlod/core/image.h"
#include "hlod/render/gl_object.h"

namespace hlodbench {

// The colour of a framebuffer (0: the window's), from its lower left corner on.
Image readFramebuffer(GLuint framebuffer, int width, int height);

// Off-screen colour (RGBA8) and depth (24 bits), without multisampling: SAMPLES_PASSED counts
// pixels.
class Framebuffer {
 public:
  // Throws std::runtime_error when the driver refuses the size.
  Framebuffer(int width, int height);

  void bind() const;
  // Copies the colour into another framebuffer (0: the window's), scaled to the rectangle, whose
  // origin is at the lower left, pixels.
  void blit(GLuint target, int x, int y, int width, int height) const;
  [[nodiscard]] Image readColor() const { return readFramebuffer(framebuffer_, width_, height_); }
  // As stored, 0 to 1, rows from the top.
  [[nodiscard]] std::vector<float> readDepth() const;
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  int width_, height_;
  GlFramebuffer framebuffer_;
  GlRenderbuffer color_, depth_;
};

}  // namespace hlodbench
