#include "gui/viewer.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>

#include "gui/panels.h"
#include "interrupt.h"
#include "picture.h"
#include "traversals/plugin_library.h"
#include "viewport_size.h"

namespace hlodbench {
namespace {

constexpr float kPanelWidth = 310.0f;    // pixels of a monitor of 96 dpi
constexpr std::size_t kShownPoses = 60;  // that a comparison begins before its frame

Lens makeLens(const ViewOptions& options) {
  Lens lens;
  applySize(options.size, lens);
  lens.fovyRad = glm::radians(options.fovyDegrees);
  return lens;
}

WindowOptions makeWindowOptions(const ViewOptions& options) {
  const Lens lens = makeLens(options);
  return {lens.width + static_cast<int>(kPanelWidth), lens.height,
          fmt::format("{} - hlodbench", options.scene.filename().string()), !options.noVsync,
          options.glDebug};
}

bool isSameLens(const Lens& a, const Lens& b) {
  return a.width == b.width && a.height == b.height && a.fovyRad == b.fovyRad &&
         a.nearPlane == b.nearPlane && a.farPlane == b.farPlane;
}

}  // namespace

Viewer::Viewer(const ViewOptions& given)
    : options(given),
      window(makeWindowOptions(given)),
      gui(window),
      strategies(listStrategies(given.plugins)),
      lens(makeLens(given)) {
  fmt::print(stderr, "window: {}, OpenGL {}\n", window.renderer, window.version);
  // the panel is as large as the monitor's density makes it, the view as was asked for
  window.resize(
      lens.width + static_cast<int>(kPanelWidth * static_cast<float>(window.contentScale())),
      lens.height);
  load();
  if (!isOpen_) return;
  makeSceneParts();
  // for scripts, which may send keys from here on
  fmt::print(stderr, "showing {}: {} triangles, {} nodes\n", stored.sceneName,
             stored.hierarchy.inputTriangles, stored.hierarchy.nodes.size());
}

Viewer::~Viewer() = default;

bool Viewer::run() {
  if (!isOpen_) return true;
  catchInterrupts();
  lastTime_ = glfwGetTime();
  // what cannot be saved is not thrown away: once more closes the window all the same
  for (bool wasTold = false;; wasTold = true) {
    while (!window.isClosing() && !isInterrupted()) showFrame();
    finish();
    if (recorder->isSaved() || isInterrupted() || options.frames > 0 || wasTold) break;
    messages.warn(
        "not saved: choose another file, or close the window again; the recording is "
        "also in " +
        nameJournal(recorder->file()).string());
    window.stayOpen();
  }
  return recorder->isSaved() && !isPictureMissing_;
}

void Viewer::finish() {
  if (!recorder->isSaved()) saveRecording();
}

float Viewer::panelWidth() const {
  return showsPanel ? kPanelWidth * gui.scale() : 0.0f;
}

Area Viewer::stageArea() const {
  const glm::ivec2 size = window.size();
  const int left = std::min(static_cast<int>(panelWidth()), size.x - 1);
  return {left, 0, size.x - left, size.y};
}

Camera Viewer::currentCamera() {
  if (!player.empty() && !stage->isFrozen())
    return makeCamera(player.session().lens, player.pose());
  const Area area = stage->paneArea(stageArea(), 0);
  Lens fitted = lens;
  fitted.width = std::max(1, area.width);
  fitted.height = std::max(1, area.height);
  // a recording keeps the lens that it was begun with
  if (!recorder->recording().empty() && !stage->isFrozen()) fitted = recorder->lens();
  return makeCamera(fitted, camera->pose());
}

void Viewer::showFrame() {
  const double now = glfwGetTime();
  const double seconds = now - lastTime_;
  lastTime_ = now;
  const std::vector<WindowEvent> events = window.takeEvents();
  if (window.size().x <= 0 || window.size().y <= 0) return;  // minimised
  gui.beginFrame();
  controls_.take(events, gui.wantsPointer(), gui.wantsKeys());
  for (const auto& file : controls_.dropped()) openSession(file);
  for (const Command command : controls_.commands()) obey(command);
  moveCamera(seconds);
  const Camera shown = currentCamera();
  record();
  attempt([&] { stage->render(shown, stageArea()); });
  noteShown(shown, seconds);
  if (const auto picture = stage->takePicture())
    attempt([&] {
      writePicture(pictureFile_, *picture);
      messages.tell(fmt::format("wrote {}", pictureFile_.string()));
    });
  pollComparison();
  const glm::ivec2 size = window.size();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, size.x, size.y);
  showPanels(*this, panelWidth());
  gui.endFrame();
  ++frames_;
  const bool isLast = options.frames > 0 && frames_ >= options.frames;
  if (wantsWindowPicture_ || (isLast && !options.picture.empty())) {
    const bool isKept = attempt([&] {
      const std::filesystem::path file = wantsWindowPicture_ ? pictureFile_ : options.picture;
      writePicture(file, window.readPixels());
      messages.tell(fmt::format("wrote {}", file.string()));
    });
    isPictureMissing_ = isLast && !isKept;
    wantsWindowPicture_ = false;
  }
  if (isLast) window.close();
  window.swap();
}

void Viewer::moveCamera(double seconds) {
  const CameraInput input = controls_.cameraInput(seconds);
  if (!player.empty() && !stage->isFrozen()) {
    player.advance(seconds);
    camera->setPose(player.pose());  // who leaves the session goes on from where it is
    return;
  }
  if (const auto point = controls_.picked()) {
    const glm::dvec2 fromBelow(point->x, window.size().y - point->y);
    if (const auto target = stage->pick(fromBelow, stageArea())) camera->goTo(*target);
  }
  camera->update(input, currentCamera().lens);
}

void Viewer::record() {
  if (recorder->state() == SessionRecorder::State::kRecording)
    attempt([&] { recorder->add(glfwGetTime(), camera->pose()); });
}

void Viewer::noteShown(const Camera& shown, double seconds) {
  if (stage->isFrozen()) return;
  if (!isSameLens(shown.lens, shownLens_)) shownPoses_.clear();
  shownLens_ = shown.lens;
  shownPoses_.push_back(shown.pose);
  if (shownPoses_.size() > kShownPoses) shownPoses_.pop_front();
  std::vector<FrameRecord> records;
  for (std::size_t i = 0; i < stage->paneCount(); ++i) {
    ScenePane& pane = stage->pane(i);
    records.push_back(pane.record());
    if (const std::string error = pane.takeError(); !error.empty()) messages.warn(error);
  }
  history.add(seconds, records);
}

}  // namespace hlodbench
