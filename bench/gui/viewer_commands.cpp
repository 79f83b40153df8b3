// What each key asks for.
#include "gui/viewer.h"

namespace hlodbench {
namespace {
constexpr double kFovStep = 1.1;  // of the keys, a factor
}

void Viewer::obey(Command command) {
  switch (command) {
    case Command::kHelp:
      showsHelp = !showsHelp;
      break;
    case Command::kOrbit:
      camera->setMode(CameraMode::kOrbit);
      break;
    case Command::kFly:
      camera->setMode(CameraMode::kFly);
      break;
    case Command::kWalk:
      camera->setMode(CameraMode::kWalk);
      break;
    case Command::kReset:
      camera->reset();
      break;
    case Command::kNarrower:
      setFov(lens.fovyRad / kFovStep);
      break;
    case Command::kWider:
      setFov(lens.fovyRad * kFovStep);
      break;
    case Command::kRecord:
      toggleRecording();
      break;
    case Command::kSave:
      saveRecording();
      break;
    case Command::kCut:
      cutRecording();
      break;
    case Command::kUndo:
      undoRecording();
      break;
    case Command::kPlay:
      if (player.empty()) reviewRecording();
      if (!player.empty()) player.play(!player.isPlaying());
      break;
    case Command::kStepBack:
      if (!player.empty()) player.step(-1);
      break;
    case Command::kStepOn:
      if (!player.empty()) player.step(1);
      break;
    case Command::kNextStrategy:
      chooseNextStrategy();
      break;
    case Command::kSplit:
      toggleSplit();
      break;
    case Command::kOverlay:
      chooseNextOverlay();
      break;
    case Command::kBoxes:
      stage->look.boxes = static_cast<Boxes>((static_cast<int>(stage->look.boxes) + 1) % 5);
      break;
    case Command::kFreeze:
      toggleFreeze();
      break;
    case Command::kPicture:
      keepPicture(false);
      break;
    case Command::kWindowPicture:
      keepPicture(true);
      break;
    case Command::kReport:
      compareFrame();
      break;
    case Command::kPanel:
      showsPanel = !showsPanel;
      break;
    case Command::kVsync:
      window.setVsync(!window.hasVsync());
      break;
    case Command::kYes:
      answerQuestion(true);
      break;
    case Command::kEscape:
      if (answerQuestion(false)) break;
      showsHelp = false;
      if (!player.empty()) closeSession();
      break;
    case Command::kQuit:
      window.close();
      break;
  }
}

}  // namespace hlodbench
