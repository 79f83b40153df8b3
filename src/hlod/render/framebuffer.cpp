#include "hlod/render/framebuffer.h"

#include <algorithm>
#include <stdexcept>

#include "hlod/render/gl_debug.h"

namespace hlodbench {

namespace {

// OpenGL's rows go up.
template <typename T>
void flipRows(std::vector<T>& pixels, std::size_t row) {
  for (auto top = pixels.begin(), bottom = pixels.end(); bottom - top > static_cast<long>(row);) {
    bottom -= static_cast<long>(row);
    std::swap_ranges(top, top + static_cast<long>(row), bottom);
    top += static_cast<long>(row);
  }
}

}  // namespace

Image readFramebuffer(GLuint framebuffer, int width, int height) {
  Image image{width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height)};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
  flipRows(image.pixels, std::size_t{4} * width);
  return image;
}

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

void Framebuffer::blit(GLuint target, int x, int y, int width, int height) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target);
  const bool isScaled = width != width_ || height != height_;
  glBlitFramebuffer(0, 0, width_, height_, x, y, x + width, y + height, GL_COLOR_BUFFER_BIT,
                    isScaled ? GL_LINEAR : GL_NEAREST);
}

std::vector<float> Framebuffer::readDepth() const {
  std::vector<float> depth(std::size_t{1} * width_ * height_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glReadPixels(0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT, depth.data());
  flipRows(depth, static_cast<std::size_t>(width_));
  return depth;
}

}  // namespace hlodbench
