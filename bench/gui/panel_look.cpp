// The camera, and what is seen of the nodes.
#include <imgui.h>

#include <glm/gtc/constants.hpp>

#include "gui/panels.h"
#include "gui/viewer.h"
#include "overlay.h"

namespace hlodbench {
namespace {

void editCamera(Viewer& viewer) {
  int mode = static_cast<int>(viewer.camera->mode());
  bool changed = false;
  constexpr const char* kModes[] = {"orbit", "fly", "walk"};  // as CameraMode
  for (int i = 0; i < 3; ++i) {
    if (i > 0) ImGui::SameLine();
    changed |= ImGui::RadioButton(kModes[i], &mode, i);
  }
  if (changed) viewer.camera->setMode(static_cast<CameraMode>(mode));
  ImGui::SameLine();
  if (ImGui::Button("reset")) viewer.camera->reset();
  float degrees = static_cast<float>(glm::degrees(viewer.lens.fovyRad));
  if (ImGui::SliderFloat("field, degrees", &degrees, 10.0f, 120.0f, "%.0f",
                         ImGuiSliderFlags_AlwaysClamp))
    viewer.setFov(glm::radians(static_cast<double>(degrees)));
  const glm::dvec3 eye = viewer.camera->pose().position;
  ImGui::Text("at %.2f %.2f %.2f", eye.x, eye.y, eye.z);
  if (viewer.camera->mode() != CameraMode::kOrbit)
    ImGui::Text("%.3g units a second", viewer.camera->speed());
}

void editLook(Viewer& viewer) {
  Stage& stage = *viewer.stage;
  const std::string& current = stage.look.overlay;
  if (ImGui::BeginCombo("overlay", current.empty() ? "none" : current.c_str())) {
    if (ImGui::Selectable("none", current.empty())) stage.look.overlay.clear();
    for (const OverlayInfo& overlay : listOverlays()) {
      if (ImGui::Selectable(std::string(overlay.name).c_str(), overlay.name == current))
        stage.look.overlay = overlay.name;
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(overlay.description).c_str());
    }
    ImGui::EndCombo();
  }
  constexpr const char* kBoxes[] = {"none", "drawn", "queried", "culled", "all"};  // as Boxes
  int boxes = static_cast<int>(stage.look.boxes);
  if (ImGui::Combo("boxes", &boxes, kBoxes, 5)) stage.look.boxes = static_cast<Boxes>(boxes);
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("drawn white; queried and seen green, hidden red; outside the frustum blue");
}

}  // namespace

void showLookPanel(Viewer& viewer) {
  if (!ImGui::CollapsingHeader("Camera and look", ImGuiTreeNodeFlags_DefaultOpen)) return;
  editCamera(viewer);
  editLook(viewer);
  bool frozen = viewer.stage->isFrozen();
  if (ImGui::Checkbox("frozen", &frozen)) viewer.toggleFreeze();
  ImGui::SameLine();
  bool split = viewer.stage->paneCount() > 1;
  if (ImGui::Checkbox("split", &split)) viewer.toggleSplit();
  ImGui::SameLine();
  bool vsync = viewer.window.hasVsync();
  if (ImGui::Checkbox("vsync", &vsync)) viewer.window.setVsync(vsync);
  if (ImGui::Button("keep picture")) viewer.keepPicture(false);
  ImGui::SameLine();
  if (ImGui::Button("open in the report")) viewer.compareFrame();
  if (viewer.comparison && !viewer.comparison->message().empty())
    ImGui::TextWrapped("%s", viewer.comparison->message().c_str());
}

}  // namespace hlodbench
