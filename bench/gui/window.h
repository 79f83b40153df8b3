#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hlod/core/image.h"
#include "hlod/render/gl_context.h"

struct GLFWwindow;

namespace hlodbench {

// What happened at the window, in order. Nothing is lost between two frames, however long they are.
struct WindowEvent {
  enum class Type { kKey, kButton, kPointer, kWheel, kFocus, kDrop };
  Type type;
  int code = 0;           // kKey: GLFW_KEY_...; kButton: GLFW_MOUSE_BUTTON_...
  bool pressed = false;   // kKey, kButton: down or up; kFocus: gained or lost
  bool repeated = false;  // kKey: held down
  int modifiers = 0;      // kKey, kButton: GLFW_MOD_...
  glm::dvec2 point{0.0};  // kButton, kPointer: pixels of the framebuffer from the upper left;
                          // kWheel: notches
  std::filesystem::path file{};  // kDrop
};

struct WindowOptions {
  int width = 960,
      height = 480;  // of its inside, pixels of the framebuffer if the system allows it
  std::string title = "hlodbench";
  bool vsync = true;
  bool debug = false;  // as in GlContextOptions
};

// A window with a current OpenGL context (3.3 core or later), by GLFW. One at a time in a process.
class Window final : public GlContext {
 public:
  // Throws GlUnavailable, saying how to go on: without a display, or where OpenGL is too old.
  explicit Window(const WindowOptions& options);
  ~Window() override;
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  [[nodiscard]] bool isClosing() const;
  void close();
  void stayOpen();  // takes back what the user did to close it
  // Handles what has happened; waits for something where the window shows nothing (minimised).
  std::vector<WindowEvent> takeEvents();
  // Waits for the next screen refresh, with vsync on.
  void swap();
  void setVsync(bool on);
  [[nodiscard]] bool hasVsync() const { return vsync_; }
  void resize(int width, int height);  // of its inside, pixels of the framebuffer

  // What is drawn and not shown yet. Other windows over it may leave holes.
  [[nodiscard]] Image readPixels() const;
  [[nodiscard]] glm::ivec2 size() const;      // of the framebuffer, pixels; 0 when minimised
  [[nodiscard]] double contentScale() const;  // of the monitor that it is on: 2 for high-DPI ones
  [[nodiscard]] GLFWwindow* handle() const { return window_; }

 private:
  struct Callbacks;

  GLFWwindow* window_ = nullptr;
  bool vsync_ = true;
  std::vector<WindowEvent> events_;
  // Where the last event of it was: GLFW would tell where it is now, which a button pressed before
  // has not been.
  glm::dvec2 pointer_{0.0};
};

}  // namespace hlodbench
