#pragma once

#include <glad/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "hlod/core/error.h"
#include "hlod/render/framebuffer.h"
#include "hlod/render/gl_context.h"

namespace hlodbench::testing {

// Makes a context in which every GL error ends the program, or null and the reason.
inline std::unique_ptr<GlContext> tryContext(const std::string& name, std::string& reason) {
  try {
    return createContext(name, {.debug = true});
  } catch (const GlUnavailable& error) {
    reason = error.what();
    return nullptr;
  }
}

// A test with a context: the one that HLODBENCH_TEST_CONTEXT names, else the first to be had.
// Skips, with the reason, where there is none.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* name = std::getenv("HLODBENCH_TEST_CONTEXT");
    std::string reason;
    context_ = tryContext(name != nullptr ? name : "auto", reason);
    if (context_ == nullptr) GTEST_SKIP() << "NO OPENGL, NOTHING TESTED: " << reason;
  }
  // Where the driver has no debug output, an error shows up here.
  void TearDown() override {
    if (context_ != nullptr) {
      EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    }
  }

  std::unique_ptr<GlContext> context_;
};

inline bool isCovered(const Image& image, int x, int y) {
  return image.pixels[4 * (static_cast<std::size_t>(y) * image.width + x) + 3] != 0;
}

inline int countCovered(const Image& image) {
  int covered = 0;
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) covered += image.pixels[i] != 0 ? 1 : 0;
  return covered;
}

}  // namespace hlodbench::testing
