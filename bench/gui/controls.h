#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <vector>

#include "gui/window.h"
#include "view/camera_control.h"

namespace hlodbench {

// What a key can ask for.
enum class Command {
  kHelp,
  kOrbit,
  kFly,
  kWalk,
  kReset,
  kNarrower,
  kWider,
  kRecord,
  kSave,
  kCut,
  kUndo,
  kPlay,
  kStepBack,
  kStepOn,
  kNextStrategy,
  kSplit,
  kOverlay,
  kBoxes,
  kFreeze,
  kPicture,
  kWindowPicture,
  kReport,
  kPanel,
  kVsync,
  kYes,
  kEscape,
  kQuit
};

// One line of the help.
struct KeyHelp {
  std::string_view keys, meaning;
};

// Every key and every use of the pointer, as the help shows them.
std::span<const KeyHelp> listKeys();

// Turns what happened at the window into what it asks for.
class Controls {
 public:
  // Takes the events of one frame. Those that are meant for widgets move nothing.
  void take(const std::vector<WindowEvent>& events, bool widgetsHavePointer, bool widgetsHaveKeys);

  // Of the frame; seconds: since the last one.
  [[nodiscard]] CameraInput cameraInput(double seconds) const;
  [[nodiscard]] const std::vector<Command>& commands() const { return commands_; }
  // Where the user double-clicked, pixels of the framebuffer from the upper left.
  [[nodiscard]] const std::optional<glm::dvec2>& picked() const { return picked_; }
  [[nodiscard]] const std::vector<std::filesystem::path>& dropped() const { return dropped_; }

 private:
  void takeKey(const WindowEvent& event);
  void takeButton(const WindowEvent& event);
  void takePointer(const WindowEvent& event);

  std::set<int> heldKeys_;
  std::optional<int> draggingButton_;
  bool panning_ = false;
  glm::dvec2 pointer_{0.0};
  std::optional<WindowEvent> lastClick_;
  double lastClickTime_ = 0.0;  // seconds
  // of the frame
  std::set<int> tappedKeys_;  // pressed in it, even if they were let go again
  glm::dvec2 turn_{0.0}, pan_{0.0};
  double wheel_ = 0.0;
  std::vector<Command> commands_;
  std::optional<glm::dvec2> picked_;
  std::vector<std::filesystem::path> dropped_;
};

}  // namespace hlodbench
