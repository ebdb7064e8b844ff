#include "app/ui/loading.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace weft::app::ui {

namespace {

void drawBar(const std::string& name, const char* stage, float done) {
  ImGui::TextUnformatted(fmt::format("{}: {}", name, stage).c_str());
  ImGui::ProgressBar(done, {-1, 0}, fmt::format("{:.0f} %", done * 100.0f).c_str());
}

}  // namespace

void drawLoading(const LiveGraph& live) {
  const auto environment = live.environment().status();
  const auto scene = live.scene().status();
  if (!environment && !scene) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float width = std::min(420.0f * ImGui::GetIO().FontGlobalScale, screen.x - 16);
  // Between the panels, which end at three quarters, and the log.
  ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.8f - 12}, ImGuiCond_Always, {0.5f, 1});
  ImGui::SetNextWindowSize({width, 0}, ImGuiCond_Always);
  ImGui::Begin("Loading", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoSavedSettings);
  if (environment) drawBar(environment->name, environment->stage, environment->done);
  if (scene) drawBar(scene->name, scene->stage, scene->done);
  ImGui::End();
}

}  // namespace weft::app::ui
