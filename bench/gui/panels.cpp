#include "gui/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include "gui/viewer.h"

namespace hlodbench {
namespace {

void showScene(const Viewer& viewer) {
  const Hierarchy& hierarchy = viewer.stored.hierarchy;
  ImGui::TextWrapped("%s: %s triangles, %zu nodes", viewer.stored.sceneName.c_str(),
                     fmt::format("{:L}", hierarchy.inputTriangles).c_str(), hierarchy.nodes.size());
  ImGui::TextDisabled("? shows the keys");
}

}  // namespace

void showPanels(Viewer& viewer, float width) {
  if (viewer.showsPanel) {
    ImGui::SetNextWindowPos({0.0f, 0.0f});
    ImGui::SetNextWindowSize({width, ImGui::GetIO().DisplaySize.y});
    ImGui::Begin("hlodbench", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PushItemWidth(-0.34f * width);  // the labels' share
    showScene(viewer);
    showStrategyPanel(viewer);
    showCounterPanel(viewer);
    showSessionPanel(viewer);
    showLookPanel(viewer);
    ImGui::PopItemWidth();
    ImGui::End();
  }
  showQuestions(viewer);
  if (viewer.showsHelp) showHelp(viewer);
  viewer.messages.show(viewer.showsPanel ? width : 0.0f);
}

}  // namespace hlodbench
