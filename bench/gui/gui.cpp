#include "gui/gui.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cmath>

namespace hlodbench {
namespace {
constexpr float kFontSize = 13.0f;  // that of the built-in font, whose pixels stay sharp
}

Gui::Gui(Window& window) : window_(window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // no file is left in the working directory
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::applyScale(float scale) {
  if (scale == scale_) return;
  scale_ = scale;
  ImGui::GetStyle() = ImGuiStyle();
  ImGui::StyleColorsDark();
  ImGui::GetStyle().ScaleAllSizes(scale);
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  ImFontConfig config;
  config.SizePixels = std::round(kFontSize * scale);
  fonts.AddFontDefault(&config);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Gui::beginFrame() {
  ImGui_ImplOpenGL3_NewFrame();
  applyScale(static_cast<float>(window_.contentScale()));  // the window may have changed monitors
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Gui::endFrame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::wantsPointer() const {
  return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::wantsKeys() const {
  return ImGui::GetIO().WantTextInput;
}

}  // namespace hlodbench
