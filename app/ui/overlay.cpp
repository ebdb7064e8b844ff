#include "app/ui/overlay.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_freetype.h>
#include <imgui_internal.h>

#include "engine/text/files/file.h"

namespace weft::app::ui {

std::unique_ptr<Overlay> Overlay::create(GLFWwindow* window, float scale) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigInputTextCursorBlink = false;
  io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  if (!ImGui_ImplGlfw_InitForOpenGL(window, false) || !ImGui_ImplOpenGL3_Init("#version 450 core"))
    return nullptr;
  std::unique_ptr<Overlay> overlay(new Overlay(window));
  overlay->setScale(scale);
  return overlay;
}

void Overlay::setScale(float scale) {
  // Text is drawn anew at its size: Latin, Greek, Cyrillic and mathematics. Dear ImGui's own font would be stretched.
  constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";  // of fonts-dejavu-core
  static constexpr ImWchar kScripts[] = {0x20, 0x52f, 0x1e00, 0x22ff, 0x25a0, 0x25ff, 0};
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  const bool own =
      text::isThere(kFont) && io.Fonts->AddFontFromFileTTF(kFont, textSize(scale), nullptr, kScripts);
  if (!own) io.Fonts->AddFontDefault();
  io.FontGlobalScale = own ? 1 : scale;
  ImGui_ImplOpenGL3_DestroyFontsTexture();  // made anew by the next frame
  ImGui_ImplOpenGL3_DestroyDeviceObjects();
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();  // sizes cannot be scaled back
  ImGui::StyleColorsDark();
  style.ScaleAllSizes(scale);
  style.WindowBorderSize = 0;
  style.Colors[ImGuiCol_WindowBg].w = 1;
  style.Colors[ImGuiCol_TextDisabled] = {0.66f, 0.66f, 0.66f, 1};
}

void Overlay::setMouseEnabled(bool enabled) {
  int& flags = ImGui::GetIO().ConfigFlags;
  flags = enabled ? flags & ~ImGuiConfigFlags_NoMouse : flags | ImGuiConfigFlags_NoMouse;
}

Overlay::~Overlay() {
  skip();
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Overlay::take(const WindowEvent& event) {
  switch (event.kind) {
    case WindowEvent::Kind::move:
      x_ = static_cast<float>(event.x);
      y_ = static_cast<float>(event.y);
      inside_ = true;
      return;
    case WindowEvent::Kind::leave:
      inside_ = down_[0] || down_[1] || down_[2];
      return;
    case WindowEvent::Kind::button:
      if (event.key >= 0 && event.key < 3) down_[event.key] = event.action == GLFW_PRESS;
      return;
    case WindowEvent::Kind::wheel:
      return ImGui_ImplGlfw_ScrollCallback(window_, event.x, event.y);
    case WindowEvent::Kind::key:
      return ImGui_ImplGlfw_KeyCallback(window_, event.key, event.scancode, event.action, event.mods);
    case WindowEvent::Kind::character:
      return ImGui_ImplGlfw_CharCallback(window_, event.codepoint);
  }
}

void Overlay::begin() {
  if (std::exchange(begun_, true)) return;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = inside_ ? ImVec2(x_, y_) : ImVec2(-FLT_MAX, -FLT_MAX);
  for (std::size_t i = 0; i < 3; ++i) io.MouseDown[i] = down_[i];
  ImGui::NewFrame();
}

void Overlay::end() {
  begun_ = false;
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Overlay::skip() {
  if (std::exchange(begun_, false)) ImGui::EndFrame();
}

std::optional<std::pair<int, int>> Overlay::releasedMouse() const {
  if (!ImGui::IsMouseReleased(ImGuiMouseButton_Left)) return std::nullopt;
  const ImVec2 at = ImGui::GetIO().MousePos;
  return std::pair(static_cast<int>(at.x), static_cast<int>(at.y));
}

bool Overlay::wantsMouse() const {
  return ImGui::GetIO().WantCaptureMouse;
}

// WantTextInput alone still holds in the layout after Enter has closed the field.
bool Overlay::wantsKeys() const {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  return context.IO.WantTextInput && context.ActiveId == context.InputTextState.ID;
}

bool Overlay::listOpen() const {
  return !ImGui::GetCurrentContext()->OpenPopupStack.empty();
}

bool Overlay::closePopup() {
  if (!listOpen()) return false;
  ImGui::ClosePopupToLevel(0, true);
  return true;
}

}  // namespace weft::app::ui
