#include "hlod/render/framebuffer.h"

#include <algorithm>
#include <stdexcept>

#include "hlod/render/gl_debug.h"

namespace hlodbench {

Framebuffer::Framebuffer(int width, int height) : width_(width), height_(height) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glBindRenderbuffer(GL_RENDERBUFFER, color_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("no off-screen framebuffer of " + std::to_string(width) + "x" +
                             std::to_string(height) + " pixels");
  labelGlObject(GL_FRAMEBUFFER, framebuffer_, "frame");
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width_, height_);
}

Image Framebuffer::readColor() const {
  Image image{width_, height_, std::vector<std::uint8_t>(std::size_t{4} * width_ * height_)};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
  const std::size_t row = std::size_t{4} * width_;
  for (int top = 0, bottom = height_ - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(image.pixels.begin() + top * row, image.pixels.begin() + (top + 1) * row,
                     image.pixels.begin() + bottom * row);
  return image;
}

}  // namespace hlodbench
