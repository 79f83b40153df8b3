// Which strategy draws, and how.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "gui/panels.h"
#include "gui/viewer.h"

namespace hlodbench {
namespace {

void chooseStrategy(Viewer& viewer, std::size_t pane) {
  const StrategyInfo& current = viewer.stage->pane(pane).info();
  const std::string label = viewer.stage->paneCount() == 1 ? "strategy"
                            : pane == 0                    ? "left"
                                                           : "right";
  if (!ImGui::BeginCombo(label.c_str(), std::string(current.label).c_str())) return;
  for (const StrategyInfo& info : viewer.strategies) {
    if (info.needsRecording) continue;
    if (ImGui::Selectable(std::string(info.label).c_str(), info.name == current.name))
      viewer.chooseStrategy(pane, std::string(info.name));
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(info.description).c_str());
  }
  ImGui::EndCombo();
}

void editChoice(Viewer& viewer, std::size_t pane, const plugin::OptionInfo& info,
                const std::string& value) {
  if (!ImGui::BeginCombo(info.name, value.c_str())) return;
  std::string_view rest = info.choices;
  while (!rest.empty()) {
    const std::string name(rest.substr(0, rest.find(',')));
    rest.remove_prefix(std::min(rest.size(), name.size() + 1));
    if (ImGui::Selectable(name.c_str(), name == value))
      viewer.setStrategyOption(pane, info.name, name);
  }
  ImGui::EndCombo();
}

void editOption(Viewer& viewer, std::size_t pane, const plugin::OptionInfo& info) {
  const plugin::OptionValues values = viewer.stage->pane(pane).ownOptions().values();
  switch (info.type) {
    case plugin::OptionType::kBool: {
      bool on = values.flag(info.name);
      if (ImGui::Checkbox(info.name, &on))
        viewer.setStrategyOption(pane, info.name, on ? "on" : "off");
      break;
    }
    case plugin::OptionType::kInt: {
      int number = static_cast<int>(values.integer(info.name));
      if (ImGui::InputInt(info.name, &number))
        viewer.setStrategyOption(pane, info.name, std::to_string(number));
      break;
    }
    case plugin::OptionType::kDouble: {
      double number = values.number(info.name);
      if (ImGui::InputDouble(info.name, &number, 0.0, 0.0, "%g",
                             ImGuiInputTextFlags_EnterReturnsTrue))
        viewer.setStrategyOption(pane, info.name, fmt::format("{}", number));
      break;
    }
    case plugin::OptionType::kChoice:
      editChoice(viewer, pane, info, values.choice(info.name));
      break;
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", info.meaning);
}

bool editLatency(Latency& latency) {
  constexpr const char* kKinds[] = {"the driver's", "frames", "draws"};  // as Latency::Kind
  int kind = static_cast<int>(latency.kind);
  bool changed = ImGui::Combo("latency", &kind, kKinds, 3);
  latency.kind = static_cast<Latency::Kind>(kind);
  if (latency.kind != Latency::Kind::kGl) {
    int count = static_cast<int>(latency.count);
    changed |= ImGui::SliderInt("results after", &count, 0,
                                latency.kind == Latency::Kind::kFrames ? 3 : 200);
    latency.count = static_cast<std::uint32_t>(std::clamp(count, 0, 1'000'000));
  }
  return changed;
}

}  // namespace

void showStrategyPanel(Viewer& viewer) {
  if (!ImGui::CollapsingHeader("Strategy", ImGuiTreeNodeFlags_DefaultOpen)) return;
  for (std::size_t i = 0; i < viewer.stage->paneCount(); ++i) chooseStrategy(viewer, i);
  PaneSettings settings = viewer.stage->pane(0).settings();
  bool changed = false;
  const auto slide = [&](const char* name, double& value, double least, double most,
                         const char* format, ImGuiSliderFlags flags = 0) {
    changed |= ImGui::SliderScalar(name, ImGuiDataType_Double, &value, &least, &most, format,
                                   flags | ImGuiSliderFlags_AlwaysClamp);
  };
  slide("tau, pixels", settings.traversal.tau, 0.1, 20.0, "%.2f", ImGuiSliderFlags_Logarithmic);
  slide("s", settings.traversal.bias.s, 0.0, 1.0, "%.2f");
  slide("t", settings.traversal.bias.t, 0.0, 1.0, "%.2f");
  changed |= editLatency(settings.latency);
  if (changed) viewer.configurePanes(settings);
  for (std::size_t i = 0; i < viewer.stage->paneCount(); ++i) {
    const StrategyInfo& info = viewer.stage->pane(i).info();
    if (info.options.empty()) continue;
    const std::string title = fmt::format("options of {}##{}", info.label, i);
    if (!ImGui::TreeNode(title.c_str())) continue;
    for (const plugin::OptionInfo& option : info.options) editOption(viewer, i, option);
    ImGui::TreePop();
  }
}

}  // namespace hlodbench
