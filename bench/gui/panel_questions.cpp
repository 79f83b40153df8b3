// What the user is asked, and the list of keys.
#include <fmt/format.h>
#include <imgui.h>

#include "gui/panels.h"
#include "gui/viewer.h"

namespace hlodbench {
namespace {

// A window in the middle; what is in it is described until ImGui::End().
void beginInTheMiddle(const char* title) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, size);
  ImGui::Begin(
      title, nullptr,
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
}

// A path may be wider than the window.
void showText(const std::string& text) {
  ImGui::PushTextWrapPos(0.8f * ImGui::GetIO().DisplaySize.x);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

void askAboutOtherScene(Viewer& viewer) {
  const Session& session = *viewer.otherScenes;
  beginInTheMiddle("another scene's session");
  showText(describeOtherScene(session, viewer.stored.sceneName, viewer.stored.info.sceneHash));
  const bool show = ImGui::Button("show it all the same (Enter)");
  ImGui::SameLine();
  const bool leave = ImGui::Button("leave it (Esc)");
  ImGui::End();
  if (show || leave) viewer.answerQuestion(show);
}

void askAboutJournal(Viewer& viewer) {
  const std::filesystem::path journal = viewer.journals.front();
  beginInTheMiddle("an interrupted recording");
  showText(fmt::format("{} holds a recording that was interrupted.", journal.string()));
  const bool keep = ImGui::Button("save it as a session (Enter)");
  ImGui::SameLine();
  const bool discard = ImGui::Button("delete it");
  ImGui::SameLine();
  const bool later = ImGui::Button("later (Esc)");
  ImGui::End();
  if (discard) viewer.recoverRecording(journal, false);
  if (keep || later) viewer.answerQuestion(keep);
}

}  // namespace

void showQuestions(Viewer& viewer) {
  if (viewer.otherScenes)
    askAboutOtherScene(viewer);
  else if (!viewer.journals.empty())
    askAboutJournal(viewer);
}

void showHelp(Viewer& viewer) {
  beginInTheMiddle("keys");
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const KeyHelp& line : listKeys()) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(line.keys.data(), line.keys.data() + line.keys.size());
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(line.meaning.data(), line.meaning.data() + line.meaning.size());
    }
    ImGui::EndTable();
  }
  if (ImGui::Button("close")) viewer.showsHelp = false;
  ImGui::End();
}

}  // namespace hlodbench
