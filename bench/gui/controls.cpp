#include "gui/controls.h"

#include <GLFW/glfw3.h>

namespace hlodbench {
namespace {

constexpr double kDoubleClickSeconds = 0.4;
constexpr double kDoubleClickPixels = 6.0;

struct KeyBinding {
  int key;
  int modifiers;  // of kMeaningful; kAny: whatever is held
  Command command;
};

constexpr int kMeaningful = GLFW_MOD_SHIFT | GLFW_MOD_CONTROL;
constexpr int kAny = -1;

constexpr std::array kBindings{
    KeyBinding{GLFW_KEY_SLASH, kAny, Command::kHelp},  // ? on many keyboards
    KeyBinding{GLFW_KEY_F1, kAny, Command::kHelp},
    KeyBinding{GLFW_KEY_1, 0, Command::kOrbit},
    KeyBinding{GLFW_KEY_2, 0, Command::kFly},
    KeyBinding{GLFW_KEY_3, 0, Command::kWalk},
    KeyBinding{GLFW_KEY_HOME, kAny, Command::kReset},
    KeyBinding{GLFW_KEY_LEFT_BRACKET, kAny, Command::kNarrower},
    KeyBinding{GLFW_KEY_RIGHT_BRACKET, kAny, Command::kWider},
    KeyBinding{GLFW_KEY_R, 0, Command::kRecord},
    KeyBinding{GLFW_KEY_S, GLFW_MOD_CONTROL, Command::kSave},
    KeyBinding{GLFW_KEY_X, 0, Command::kCut},
    KeyBinding{GLFW_KEY_Z, GLFW_MOD_CONTROL, Command::kUndo},
    KeyBinding{GLFW_KEY_SPACE, kAny, Command::kPlay},
    KeyBinding{GLFW_KEY_COMMA, kAny, Command::kStepBack},
    KeyBinding{GLFW_KEY_PERIOD, kAny, Command::kStepOn},
    KeyBinding{GLFW_KEY_TAB, kAny, Command::kNextStrategy},
    KeyBinding{GLFW_KEY_V, 0, Command::kSplit},
    KeyBinding{GLFW_KEY_O, 0, Command::kOverlay},
    KeyBinding{GLFW_KEY_B, 0, Command::kBoxes},
    KeyBinding{GLFW_KEY_F, 0, Command::kFreeze},
    KeyBinding{GLFW_KEY_P, 0, Command::kPicture},
    KeyBinding{GLFW_KEY_P, GLFW_MOD_SHIFT, Command::kWindowPicture},
    KeyBinding{GLFW_KEY_C, 0, Command::kReport},
    KeyBinding{GLFW_KEY_H, 0, Command::kPanel},
    KeyBinding{GLFW_KEY_Y, 0, Command::kVsync},
    KeyBinding{GLFW_KEY_ENTER, kAny, Command::kYes},
    KeyBinding{GLFW_KEY_KP_ENTER, kAny, Command::kYes},
    KeyBinding{GLFW_KEY_ESCAPE, kAny, Command::kEscape},
    KeyBinding{GLFW_KEY_Q, GLFW_MOD_CONTROL, Command::kQuit}};

constexpr std::array kHelp{
    KeyHelp{"left drag", "turn: round the pivot (orbit), or the head (fly, walk)"},
    KeyHelp{"right or middle drag, Shift + left drag", "move in the plane of the picture"},
    KeyHelp{"wheel", "nearer and farther (orbit), or faster and slower (fly, walk)"},
    KeyHelp{"double click", "go to the point under the pointer"},
    KeyHelp{"W A S D, E Q", "forward, left, back, right; up, down. Shift: 4 times as fast"},
    KeyHelp{"1 2 3", "orbit, fly, walk"},
    KeyHelp{"Home", "back to the start"},
    KeyHelp{"[ ]", "narrower, wider field of view"},
    KeyHelp{"R", "record; pause; continue"},
    KeyHelp{"X", "cut what was recorded after the frame of the scrubber"},
    KeyHelp{"Ctrl+Z", "undo: of the recording, the last stretch or the last cut"},
    KeyHelp{"Ctrl+S", "save the recording"},
    KeyHelp{"Space", "replay; pause"},
    KeyHelp{", .", "one frame back, on"},
    KeyHelp{"Tab", "next strategy"},
    KeyHelp{"V", "split the window between two strategies"},
    KeyHelp{"O", "next overlay"},
    KeyHelp{"B", "boxes of the nodes drawn, queried, culled; all; none"},
    KeyHelp{"F", "freeze the front and look at it from outside; once more: go on"},
    KeyHelp{"P, Shift+P", "keep the picture; with the panels"},
    KeyHelp{"C", "compare this frame in the report"},
    KeyHelp{"Y", "wait for the screen's refresh (vsync), or do not"},
    KeyHelp{"H", "hide or show the panel"},
    KeyHelp{"? or F1", "these keys"},
    KeyHelp{"Enter, Esc", "answer a question. Esc: leave the session that is replayed"},
    KeyHelp{"Ctrl+Q", "quit; what was recorded is saved"}};

}  // namespace

std::span<const KeyHelp> listKeys() {
  return kHelp;
}

void Controls::take(const std::vector<WindowEvent>& events, bool widgetsHavePointer,
                    bool widgetsHaveKeys) {
  tappedKeys_.clear();
  turn_ = pan_ = glm::dvec2(0.0);
  wheel_ = 0.0;
  commands_.clear();
  picked_.reset();
  dropped_.clear();
  for (const WindowEvent& event : events) {
    switch (event.type) {
      case WindowEvent::Type::kKey:
        if (!widgetsHaveKeys || !event.pressed) takeKey(event);
        break;
      case WindowEvent::Type::kButton:
        if (!widgetsHavePointer || !event.pressed) takeButton(event);
        break;
      case WindowEvent::Type::kPointer:
        takePointer(event);
        break;
      case WindowEvent::Type::kWheel:
        if (!widgetsHavePointer) wheel_ += event.point.y;
        break;
      case WindowEvent::Type::kFocus:
        // what is held now, another window will see released
        heldKeys_.clear();
        draggingButton_.reset();
        break;
      case WindowEvent::Type::kDrop:
        dropped_.push_back(event.file);
        break;
    }
  }
}

void Controls::takeKey(const WindowEvent& event) {
  if (!event.pressed) {
    heldKeys_.erase(event.code);
    return;
  }
  // with Ctrl a letter is a command, and moves nothing
  if ((event.modifiers & GLFW_MOD_CONTROL) == 0 || event.code == GLFW_KEY_LEFT_CONTROL ||
      event.code == GLFW_KEY_RIGHT_CONTROL) {
    heldKeys_.insert(event.code);
    tappedKeys_.insert(event.code);
  }
  for (const KeyBinding& binding : kBindings) {
    if (binding.key != event.code) continue;
    if (binding.modifiers != kAny && binding.modifiers != (event.modifiers & kMeaningful)) continue;
    const bool mayRepeat =
        binding.command == Command::kStepBack || binding.command == Command::kStepOn ||
        binding.command == Command::kNarrower || binding.command == Command::kWider;
    if (!event.repeated || mayRepeat) commands_.push_back(binding.command);
  }
}

void Controls::takeButton(const WindowEvent& event) {
  pointer_ = event.point;
  if (!event.pressed) {
    if (draggingButton_ == event.code) draggingButton_.reset();
    return;
  }
  draggingButton_ = event.code;
  panning_ = event.code != GLFW_MOUSE_BUTTON_LEFT || (event.modifiers & GLFW_MOD_SHIFT) != 0;
  if (event.code != GLFW_MOUSE_BUTTON_LEFT) return;
  const double now = glfwGetTime();
  const bool isSecond = lastClick_ && now - lastClickTime_ < kDoubleClickSeconds &&
                        glm::length(lastClick_->point - event.point) < kDoubleClickPixels;
  if (isSecond) picked_ = event.point;
  lastClick_ = isSecond ? std::nullopt : std::optional(event);
  lastClickTime_ = now;
}

void Controls::takePointer(const WindowEvent& event) {
  const glm::dvec2 way = event.point - pointer_;
  pointer_ = event.point;
  if (draggingButton_) (panning_ ? pan_ : turn_) += way;
}

CameraInput Controls::cameraInput(double seconds) const {
  const auto axis = [&](int positive, int negative) {
    const auto isOn = [&](int key) {
      return heldKeys_.count(key) > 0 || tappedKeys_.count(key) > 0 ? 1.0 : 0.0;
    };
    return isOn(positive) - isOn(negative);
  };
  CameraInput input;
  input.move = {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q),
                axis(GLFW_KEY_W, GLFW_KEY_S)};
  input.turn = turn_;
  input.pan = pan_;
  input.wheel = wheel_;
  input.fast =
      heldKeys_.count(GLFW_KEY_LEFT_SHIFT) > 0 || heldKeys_.count(GLFW_KEY_RIGHT_SHIFT) > 0;
  input.seconds = seconds;
  return input;
}

}  // namespace hlodbench
