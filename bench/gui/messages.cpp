#include "gui/messages.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <cstdio>

namespace hlodbench {
namespace {
constexpr double kSeconds = 6.0;  // that a message stays
constexpr std::size_t kMost = 5;
}  // namespace

void Messages::tell(const std::string& text) {
  fmt::print(stderr, "{}\n", text);
  messages_.push_back({text, false, glfwGetTime()});
  if (messages_.size() > kMost) messages_.erase(messages_.begin());
}

void Messages::warn(const std::string& text) {
  tell("hlodbench: " + text);
  messages_.back() = {text, true, glfwGetTime()};
}

void Messages::show(float x) {
  const double now = glfwGetTime();
  std::erase_if(messages_, [&](const Message& message) {
    return !message.isWarning && now - message.time > kSeconds;
  });
  if (messages_.empty()) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({x, size.y}, ImGuiCond_Always, {0.0f, 1.0f});
  ImGui::SetNextWindowSize({size.x - x, 0.0f});
  ImGui::SetNextWindowBgAlpha(0.75f);
  ImGui::Begin("messages", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushTextWrapPos(0.0f);
  for (std::size_t i = 0; i < messages_.size();) {
    ImGui::PushID(static_cast<int>(i));
    bool isGone = false;
    if (messages_[i].isWarning) {
      isGone = ImGui::SmallButton("x");
      ImGui::SameLine();
      ImGui::TextColored({1.0f, 0.65f, 0.4f, 1.0f}, "%s", messages_[i].text.c_str());
    } else {
      ImGui::TextUnformatted(messages_[i].text.c_str());
    }
    ImGui::PopID();
    if (isGone)
      messages_.erase(messages_.begin() + static_cast<std::ptrdiff_t>(i));
    else
      ++i;
  }
  ImGui::PopTextWrapPos();
  ImGui::End();
}

}  // namespace hlodbench
