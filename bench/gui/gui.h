#pragma once

#include "gui/window.h"

namespace hlodbench {

// Dear ImGui in a window.
class Gui {
 public:
  // Keeps the window's callbacks and calls them.
  explicit Gui(Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  void beginFrame();
  // Draws what was described since beginFrame() into the window's framebuffer.
  void endFrame();
  // Whether the pointer, or the keys, are meant for a widget.
  [[nodiscard]] bool wantsPointer() const;
  [[nodiscard]] bool wantsKeys() const;
  [[nodiscard]] float scale() const { return scale_; }  // pixels of a unit of 96 dpi

 private:
  void applyScale(float scale);

  Window& window_;
  float scale_ = 0.0f;
};

}  // namespace hlodbench
