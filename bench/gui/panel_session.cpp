// Recording a session, and replaying one.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "gui/panels.h"
#include "gui/viewer.h"

namespace hlodbench {
namespace {

void showRecorder(Viewer& viewer) {
  const SessionRecorder& recorder = *viewer.recorder;
  const bool isRecording = recorder.state() == SessionRecorder::State::kRecording;
  const bool hasFrames = !recorder.recording().empty();
  const char* const action = isRecording ? "pause" : hasFrames ? "continue" : "record";
  if (ImGui::Button(action)) viewer.toggleRecording();
  const auto frames = recorder.recording().poses().size();
  ImGui::SameLine();
  const std::string length = fmt::format("{} frames, {:.1f} s{}", frames,
                                         static_cast<double>(frames) * recorder.recording().step(),
                                         recorder.isSaved() ? "" : ", not saved");
  if (isRecording)
    ImGui::TextColored({1.0f, 0.35f, 0.3f, 1.0f}, "recording: %s", length.c_str());
  else
    ImGui::TextUnformatted(length.c_str());
  if (!hasFrames) return;
  if (ImGui::Button("save")) viewer.saveRecording();
  ImGui::SameLine();
  if (ImGui::Button("review")) viewer.reviewRecording();
  ImGui::SameLine();
  if (ImGui::Button("undo")) viewer.undoRecording();
  ImGui::SameLine();
  if (ImGui::Button("discard")) ImGui::OpenPopup("discard the recording");
  if (ImGui::BeginPopup("discard the recording")) {
    if (ImGui::Button("forget what was recorded")) {
      viewer.discardRecording();
      ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
  }
  ImGui::InputText("file", &viewer.recordPath);
}

// Of what is shown: the recording in review, or the session.
void showExport(Viewer& viewer) {
  if (!ImGui::TreeNode("export")) return;
  ImGui::InputDouble("poses a second", &viewer.exportRate, 0.0, 0.0, "%g");
  ImGui::InputDouble("smooth, s", &viewer.exportSigma, 0.0, 0.0, "%g");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("standard deviation of the Gaussian that poses are averaged with, seconds");
  if (ImGui::Button("export a copy")) viewer.exportSession();
  ImGui::TreePop();
}

void showPlayer(Viewer& viewer) {
  SessionPlayer& player = viewer.player;
  const bool enter =
      ImGui::InputText("session", &viewer.sessionPath, ImGuiInputTextFlags_EnterReturnsTrue);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("a file; or drop one on the window");
  ImGui::SameLine();
  if ((ImGui::SmallButton("open") || enter) && !viewer.sessionPath.empty())
    viewer.openSession(viewer.sessionPath);
  if (player.empty()) return;
  ImGui::Text("%s: frame %zu of %zu",
              viewer.isReviewing ? "recording" : player.session().name.c_str(), player.frame() + 1,
              player.session().poses.size());
  int frame = static_cast<int>(player.frame());
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  if (ImGui::SliderInt("##frame", &frame, 0, static_cast<int>(player.session().poses.size()) - 1))
    player.seek(static_cast<std::size_t>(frame));
  if (ImGui::Button(player.isPlaying() ? "pause##replay" : "play"))
    player.play(!player.isPlaying());
  ImGui::SameLine();
  if (ImGui::Button("<")) player.step(-1);
  ImGui::SameLine();
  if (ImGui::Button(">")) player.step(1);
  ImGui::SameLine();
  if (ImGui::Button("leave")) {
    viewer.closeSession();
    return;
  }
  if (viewer.isReviewing) {
    ImGui::SameLine();
    if (ImGui::Button("cut after")) viewer.cutRecording();
  }
  ImGui::Checkbox("every frame, none left out", &player.everyFrame);
  showExport(viewer);
}

}  // namespace

void showSessionPanel(Viewer& viewer) {
  if (!ImGui::CollapsingHeader("Session", ImGuiTreeNodeFlags_DefaultOpen)) return;
  showRecorder(viewer);
  ImGui::Separator();
  showPlayer(viewer);
}

}  // namespace hlodbench
