#include "gui/viewer.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <glm/gtc/constants.hpp>
#include <mutex>

#include "gui/panels.h"
#include "hlod/core/error.h"
#include "interrupt.h"
#include "picture.h"
#include "traversals/plugin_library.h"
#include "viewport_size.h"

namespace hlodbench {
namespace {

constexpr float kPanelWidth = 310.0f;    // pixels of a monitor of 96 dpi
constexpr std::size_t kShownPoses = 60;  // that a comparison begins before its frame
constexpr double kFovStep = 1.1;         // of the keys, a factor

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

// In another thread, while the window shows how far it is.
void Viewer::load() {
  struct Canceled {};
  std::mutex mutex;
  std::string work = "reading";
  double share = 0.0;
  bool isCanceled = false;
  auto result = std::async(std::launch::async, [&] {
    return openHierarchy(options.scene, options.cache, options.build,
                         [&](const std::string& newStage, double newShare) {
                           const std::lock_guard lock(mutex);
                           if (isCanceled) throw Canceled();
                           work = newStage;
                           share = newShare;
                         });
  });
  while (result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    takeClosingKeys(false);
    std::unique_lock lock(mutex);
    isCanceled = isCanceled || window.isClosing();
    const std::string text = isCanceled ? "ending" : work;
    const double shown = share;
    lock.unlock();  // building does not wait for the screen's refresh
    showProgress(text, shown);
  }
  try {
    stored = result.get();
    isOpen_ = !window.isClosing();
  } catch (const Canceled&) {
  } catch (const InputError& error) {
    // once on the terminal, by who catches it; here until the window is closed
    while (options.frames == 0 && !window.isClosing() && !isInterrupted()) {
      takeClosingKeys(true);
      showProgress(error.what(), -1.0);
    }
    throw;
  }
}

void Viewer::takeClosingKeys(bool alsoEscape) {
  controls_.take(window.takeEvents(), false, false);
  for (const Command command : controls_.commands())
    if (command == Command::kQuit || (alsoEscape && command == Command::kEscape)) window.close();
}

// share: 0 to 1; below 0 there is no progress: an error, and Esc closes the window.
void Viewer::showProgress(const std::string& text, double share) {
  const glm::ivec2 size = window.size();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, size.x, size.y);
  glClearColor(0.1f, 0.1f, 0.1f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  gui.beginFrame();
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({0.8f * size.x, 0.0f});
  ImGui::Begin(options.scene.filename().c_str(), nullptr,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
  ImGui::TextWrapped("%s", text.c_str());
  if (share >= 0.0)
    ImGui::ProgressBar(static_cast<float>(share));
  else if (ImGui::Button("close"))
    window.close();
  ImGui::End();
  gui.endFrame();
  window.swap();
}

void Viewer::makeSceneParts() {
  const Aabb& box = stored.hierarchy.node(kRoot).box;
  lens = chooseLens(box, lens.width, lens.height, lens.fovyRad);
  std::vector<PaneSettings> panes;
  for (const std::string& strategy : options.strategies)
    panes.push_back({strategy, options.traversal, parseLatency(options.latency)});
  stage = std::make_unique<Stage>(
      stored.hierarchy, lens,
      RendererOptions{.gpuMemory = options.gpuMemory, .culling = options.faces}, strategies, panes);
  camera = std::make_unique<CameraControl>(box, lens);
  Session header;
  header.lens = lens;
  header.timeStep = 1.0 / options.rate;
  header.made = fmt::format("hlodbench view, recorded at {:g} poses a second", options.rate);
  header.up = glm::dvec3(0.0, 1.0, 0.0);
  header.scene = SessionScene{stored.sceneName, fmt::format("{:016x}", stored.info.sceneHash)};
  const std::filesystem::path file =
      options.record.empty() ? nameNewSession(options.folder, stored.sceneName) : options.record;
  header.name = file.stem().stem().string();
  recorder = std::make_unique<SessionRecorder>(header, file);
  recordPath = file.string();
  exportRate = options.rate;
  attempt([&] { journals = listJournals(file.parent_path().empty() ? "." : file.parent_path()); });
  if (!options.session.empty()) {
    sessionPath = options.session.string();
    openSession(options.session);
  }
}

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
