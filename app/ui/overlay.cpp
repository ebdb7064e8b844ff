#include "app/ui/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace weft::app::ui {

std::unique_ptr<Overlay> Overlay::create(GLFWwindow* window, float scale) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  if (!ImGui_ImplGlfw_InitForOpenGL(window, true) || !ImGui_ImplOpenGL3_Init("#version 450 core"))
    return nullptr;
  std::unique_ptr<Overlay> overlay(new Overlay);
  overlay->setScale(scale);
  return overlay;
}

void Overlay::setScale(float scale) {
  ImGui::GetIO().FontGlobalScale = scale;
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();  // sizes cannot be scaled back
  ImGui::StyleColorsDark();
  style.ScaleAllSizes(scale);
  style.WindowRounding = 3;
  style.Colors[ImGuiCol_WindowBg].w = 0.88f;
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

void Overlay::begin() {
  if (std::exchange(begun_, true)) return;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
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
bool Overlay::wantsKeys() const {
  return ImGui::GetIO().WantTextInput;
}

}  // namespace weft::app::ui
