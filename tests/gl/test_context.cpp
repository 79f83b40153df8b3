// Contexts: each kind comes up, and what is asked for or missing is said.
#include <gmock/gmock.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "gl_fixture.h"

namespace hlodbench {
namespace {

using ::testing::HasSubstr;
using testing::tryContext;

class EveryContext : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryContext, IsAtLeastOpenGl33CoreAndSaysWhatItIs) {
  std::string reason;
  const auto context = tryContext(GetParam(), reason);
  if (context == nullptr) {
    EXPECT_THAT(reason, HasSubstr("Debian package"));
    GTEST_SKIP() << "NO " << GetParam() << " CONTEXT, NOTHING TESTED: " << reason;
  }
  EXPECT_EQ(context->name, GetParam());
  EXPECT_FALSE(context->detail.empty());
  EXPECT_FALSE(context->vendor.empty());
  EXPECT_FALSE(context->renderer.empty());
  EXPECT_FALSE(context->version.empty());
  GLint major = 0;
  GLint minor = 0;
  GLint profile = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_GE(10 * major + minor, 33);
  EXPECT_NE(profile & GL_CONTEXT_CORE_PROFILE_BIT, 0);
  EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
}

TEST_P(EveryContext, ComesUpAgainAfterItWasDestroyed) {
  std::string reason;
  for (int i = 0; i < 3; ++i) {
    const auto context = tryContext(GetParam(), reason);
    if (context == nullptr)
      GTEST_SKIP() << "NO " << GetParam() << " CONTEXT, NOTHING TESTED: " << reason;
    const Framebuffer framebuffer(8, 4);
    framebuffer.bind();
    glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    const Image image = framebuffer.readColor();
    ASSERT_EQ(image.pixels.size(), 8u * 4u * 4u);
    for (std::size_t p = 0; p < image.pixels.size(); p += 4) {
      ASSERT_EQ(image.pixels[p], 255);
      ASSERT_EQ(image.pixels[p + 1], 0);
    }
  }
}

// Runs in a process of its own.
void makeGlError(const std::string& name) {
  std::string reason;
  const auto context = tryContext(name, reason);
  glEnable(GL_TEXTURE_WRAP_S);  // no capability
}

// What every other test here relies on.
TEST_P(EveryContext, WithDebugOutputEndsTheProgramOnAGlError) {
  {
    std::string reason;
    const auto context = tryContext(GetParam(), reason);
    if (context == nullptr)
      GTEST_SKIP() << "NO " << GetParam() << " CONTEXT, NOTHING TESTED: " << reason;
    if (!GLAD_GL_KHR_debug) GTEST_SKIP() << GetParam() << " HAS NO KHR_debug";
  }
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(makeGlError(GetParam()), ::testing::KilledBySignal(SIGABRT), "OpenGL: ");
}

std::vector<std::string> listContextNames() {
  std::vector<std::string> names;
  for (const GlContextInfo& info : listContexts()) names.emplace_back(info.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, EveryContext, ::testing::ValuesIn(listContextNames()),
                         [](const auto& test) { return test.param; });

TEST(Context, OfAnUnknownNameIsAnErrorThatListsTheKnownOnes) {
  try {
    createContext("glx", {});
    FAIL() << "a context named glx was made";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'glx'"));
    EXPECT_THAT(error.what(), HasSubstr("auto"));
    for (const std::string& name : listContextNames()) EXPECT_THAT(error.what(), HasSubstr(name));
  }
}

TEST(Context, AutoTakesAKnownOneAndSaysWhatItTried) {
  try {
    const auto context = createContext("auto", {});
    EXPECT_THAT(listContextNames(), ::testing::Contains(context->name));
    // a GPU through EGL is the first choice: with anything else, something was tried before
    if (context->detail.find("GPU") == std::string::npos) {
      EXPECT_FALSE(context->tried.empty());
    }
    for (const std::string& line : context->tried) EXPECT_FALSE(line.empty());
  } catch (const GlUnavailable& error) {
    GTEST_SKIP() << "NO OPENGL, NOTHING TESTED: " << error.what();
  }
}

// Runs in a process of its own: EGL without a single driver. Prints what comes of `name`.
[[noreturn]] void createWithoutEglDrivers(const char* name) {
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1);
  try {
    const auto context = createContext(name, {});
    std::fprintf(stderr, "made %s", context->name.c_str());
    for (const std::string& line : context->tried) std::fprintf(stderr, ", tried %s", line.c_str());
  } catch (const GlUnavailable& error) {
    std::fprintf(stderr, "none: %s", error.what());
  }
  std::fflush(stderr);
  std::_Exit(0);
}

TEST(ContextDeathTest, WithoutEglDriversThePackageIsNamedAndAutoGoesOn) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a fresh process, in which nothing is loaded
  EXPECT_EXIT(createWithoutEglDrivers("egl"), ::testing::ExitedWithCode(0),
              "none: egl: .*Debian packages: libegl1");
  const bool osMesa = listContexts().size() > 1;
  EXPECT_EXIT(createWithoutEglDrivers("auto"), ::testing::ExitedWithCode(0),
              osMesa ? "made osmesa, tried egl: .*libegl1|none: .*egl: .*libegl1.*libosmesa6"
                     : "none: .*libegl1");
}

}  // namespace
}  // namespace hlodbench
