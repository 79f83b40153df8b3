// What the strategies do, in numbers.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "gui/panels.h"
#include "gui/viewer.h"

namespace hlodbench {
namespace {

constexpr Counter kShown[] = {Counter::kDn,      Counter::kRarn,       Counter::kD,
                              Counter::kQueries, Counter::kTriangles,  Counter::kNodesVisited,
                              Counter::kWaitMs,  Counter::kTraversalMs};

const CounterInfo& infoOf(Counter counter) {
  return kCounterTable[static_cast<std::size_t>(counter)];
}

std::string format(double value) {
  if (std::isnan(value)) return "-";
  if (value >= 1e5) return fmt::format("{:.0f}k", value / 1e3);
  const bool isWhole = value == std::round(value);
  return isWhole || value >= 100.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.2f}", value);
}

void showTable(const Viewer& viewer) {
  const std::size_t panes = viewer.history.paneCount();
  if (!ImGui::BeginTable("counters", static_cast<int>(panes) * 2 + 1,
                         ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit))
    return;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  for (std::size_t i = 0; i < panes; ++i) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(std::string(viewer.stage->pane(i).info().label).c_str());
    ImGui::TableNextColumn();
    ImGui::TextDisabled("mean");
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("of the last %zu frames", CounterHistory::kFrames);
  }
  for (const Counter counter : kShown) {
    const CounterInfo& info = infoOf(counter);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(
        fmt::format("{}{}{}", info.label, info.unit.empty() ? "" : ", ", info.unit).c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(info.description).c_str());
    for (std::size_t i = 0; i < panes; ++i) {
      const FrameRecord& record = viewer.stage->pane(i).record();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(format(record.get(counter)).c_str());
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", format(viewer.history.mean(i, counter)).c_str());
    }
  }
  ImGui::EndTable();
}

void plot(const Viewer& viewer, Counter counter) {
  float most = 0.0f;
  std::vector<std::vector<float>> values;
  for (std::size_t i = 0; i < viewer.history.paneCount(); ++i) {
    values.push_back(viewer.history.values(i, counter));
    for (const float value : values.back()) most = std::max(most, value);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string text =
        fmt::format("{}, 0 to {}", viewer.stage->pane(i).info().label, format(most));
    ImGui::PushID(static_cast<int>(i));
    ImGui::PlotLines("##plot", values[i].data(), static_cast<int>(values[i].size()), 0,
                     text.c_str(), 0.0f, 1.05f * std::max(most, 1e-6f),
                     {ImGui::GetContentRegionAvail().x, 4.0f * ImGui::GetTextLineHeight()});
    ImGui::PopID();
  }
}

}  // namespace

void showCounterPanel(Viewer& viewer) {
  if (!ImGui::CollapsingHeader("Counters", ImGuiTreeNodeFlags_DefaultOpen)) return;
  ImGui::Text("%.1f frames a second", viewer.history.framesPerSecond());
  if (viewer.stage->isFrozen()) {
    ImGui::SameLine();
    ImGui::TextColored({1.0f, 0.82f, 0.2f, 1.0f}, "frozen");
  }
  if (viewer.history.paneCount() == 0) return;
  showTable(viewer);
  Counter& plotted = viewer.plottedCounter;
  if (ImGui::BeginCombo("plot", std::string(infoOf(plotted).label).c_str())) {
    for (const Counter counter : kShown)
      if (ImGui::Selectable(std::string(infoOf(counter).label).c_str(), counter == plotted))
        plotted = counter;
    ImGui::EndCombo();
  }
  plot(viewer, plotted);
}

}  // namespace hlodbench
