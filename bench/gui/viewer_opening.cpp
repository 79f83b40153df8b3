// How the window comes to its scene.
#include <fmt/format.h>
#include <imgui.h>

#include <future>
#include <mutex>

#include "gui/viewer.h"
#include "hlod/core/error.h"
#include "interrupt.h"

namespace hlodbench {

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
  recorder = std::make_unique<SessionRecorder>(header, file);
  recordPath = file.string();
  exportRate = options.rate;
  attempt([&] { journals = listJournals(file.parent_path().empty() ? "." : file.parent_path()); });
  if (!options.session.empty()) {
    sessionPath = options.session.string();
    openSession(options.session);
  }
}

}  // namespace hlodbench
