#include "gui/window.h"

#include <fmt/format.h>
// glad before GLFW, which would include a GL header of its own
#include <glad/gl.h>

#include <GLFW/glfw3.h>
#include <cstdlib>

#include "hlod/core/error.h"
#include "hlod/render/driver_memory.h"
#include "hlod/render/framebuffer.h"

namespace hlodbench {
namespace {

std::string describeGlfwError() {
  const char* text = nullptr;
  if (glfwGetError(&text) == GLFW_NO_ERROR || text == nullptr) return "GLFW names no reason";
  return text;
}

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

[[noreturn]] void failWithoutDisplay() {
  const std::string reason = isSet("DISPLAY") || isSet("WAYLAND_DISPLAY")
                                 ? describeGlfwError()
                                 : "DISPLAY and WAYLAND_DISPLAY are not set";
  throw GlUnavailable(fmt::format(
      "view: no display: {}. Start it on a desktop, or on a virtual one: xvfb-run -s '-screen 0 "
      "1280x1024x24' hlodbench view ...; `hlodbench run` needs no display, it draws through EGL",
      reason));
}

[[noreturn]] void failWithoutGl() {
  throw GlUnavailable(fmt::format(
      "view: expected a window with OpenGL 3.3 core or later, found none: {}. A newer driver, or "
      "Mesa's software rasteriser (LIBGL_ALWAYS_SOFTWARE=1), has it",
      describeGlfwError()));
}

// Pixels of the framebuffer per unit of the system's window coordinates.
glm::dvec2 computePixelRatio(GLFWwindow* window) {
  glm::ivec2 outer(1), inner(1);
  glfwGetWindowSize(window, &outer.x, &outer.y);
  glfwGetFramebufferSize(window, &inner.x, &inner.y);
  return outer.x > 0 && outer.y > 0 ? glm::dvec2(inner) / glm::dvec2(outer) : glm::dvec2(1.0);
}

}  // namespace

struct Window::Callbacks {
  static Window& of(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
  }
  static std::vector<WindowEvent>& events(GLFWwindow* window) { return of(window).events_; }
  static void onKey(GLFWwindow* window, int key, int /*scancode*/, int action, int modifiers) {
    events(window).push_back({.type = WindowEvent::Type::kKey,
                              .code = key,
                              .pressed = action != GLFW_RELEASE,
                              .repeated = action == GLFW_REPEAT,
                              .modifiers = modifiers});
  }
  static void onButton(GLFWwindow* window, int button, int action, int modifiers) {
    events(window).push_back({.type = WindowEvent::Type::kButton,
                              .code = button,
                              .pressed = action == GLFW_PRESS,
                              .modifiers = modifiers,
                              .point = of(window).pointer_});
  }
  static void onPointer(GLFWwindow* window, double x, double y) {
    of(window).pointer_ = glm::dvec2(x, y) * computePixelRatio(window);
    events(window).push_back({.type = WindowEvent::Type::kPointer, .point = of(window).pointer_});
  }
  static void onWheel(GLFWwindow* window, double x, double y) {
    events(window).push_back({.type = WindowEvent::Type::kWheel, .point = {x, y}});
  }
  static void onFocus(GLFWwindow* window, int focused) {
    events(window).push_back({.type = WindowEvent::Type::kFocus, .pressed = focused != 0});
  }
  static void onDrop(GLFWwindow* window, int count, const char** paths) {
    for (int i = 0; i < count; ++i)
      events(window).push_back({.type = WindowEvent::Type::kDrop, .file = paths[i]});
  }
};

Window::Window(const WindowOptions& options) : vsync_(options.vsync) {
  keepDriverMemory();
  if (!glfwInit()) failWithoutDisplay();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);  // everything is drawn off-screen first
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  window_ =
      glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
  try {
    if (window_ == nullptr) failWithoutGl();
    glfwMakeContextCurrent(window_);
    if (gladLoadGL(glfwGetProcAddress) == 0) failWithoutGl();
    detail = "a window by GLFW";
    completeContext(*this, "glfw", {options.debug});
  } catch (...) {
    glfwTerminate();
    throw;
  }
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, Callbacks::onKey);
  glfwSetMouseButtonCallback(window_, Callbacks::onButton);
  glfwSetCursorPosCallback(window_, Callbacks::onPointer);
  glfwSetScrollCallback(window_, Callbacks::onWheel);
  glfwSetWindowFocusCallback(window_, Callbacks::onFocus);
  glfwSetDropCallback(window_, Callbacks::onDrop);
  setVsync(options.vsync);
}

Window::~Window() {
  glfwTerminate();
}

bool Window::isClosing() const {
  return glfwWindowShouldClose(window_) != 0;
}

void Window::close() {
  glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::stayOpen() {
  glfwSetWindowShouldClose(window_, GLFW_FALSE);
}

std::vector<WindowEvent> Window::takeEvents() {
  constexpr double kMinimisedWait = 0.1;  // seconds
  if (size().x > 0 && size().y > 0)
    glfwPollEvents();
  else
    glfwWaitEventsTimeout(kMinimisedWait);
  return std::exchange(events_, {});
}

void Window::swap() {
  glfwSwapBuffers(window_);
}

void Window::setVsync(bool on) {
  vsync_ = on;
  glfwSwapInterval(on ? 1 : 0);
}

void Window::resize(int width, int height) {
  const glm::dvec2 outer = glm::dvec2(width, height) / computePixelRatio(window_);
  glfwSetWindowSize(window_, static_cast<int>(outer.x), static_cast<int>(outer.y));
}

Image Window::readPixels() const {
  const glm::ivec2 pixels = size();
  return readFramebuffer(0, pixels.x, pixels.y);
}

glm::ivec2 Window::size() const {
  glm::ivec2 pixels;
  glfwGetFramebufferSize(window_, &pixels.x, &pixels.y);
  return pixels;
}

double Window::contentScale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  return x;
}

}  // namespace hlodbench
