// The windows of the log and of what is being loaded. Declared in panels.h.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "app/ui/panels.h"

namespace weft::app::ui {

float Panels::logHeight() const {
  return std::max(64.0f, std::min(ImGui::GetIO().DisplaySize.y * 0.2f, ImGui::GetFontSize() * 9));
}

void Panels::drawLog() {
  const std::vector<const text::Diagnostic*> shown = log_.shown(visible);
  if (shown.empty()) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const ImGuiStyle& style = ImGui::GetStyle();
  const char* const lastGood =
      live_.good() ? nullptr : "This is the last good picture; the files on disk have errors:";
  // The first error is to be read whole, message and fix.
  float height = logHeight();
  if (shown.front()->severity == text::Severity::error) {
    const float wrap = std::max(1.0f, screen.x - 16 - 2 * style.WindowPadding.x - style.ScrollbarSize);
    float wanted = ImGui::GetFrameHeight() + 2 * style.WindowPadding.y + style.ItemSpacing.y;
    if (lastGood) wanted += ImGui::CalcTextSize(lastGood, nullptr, false, wrap).y + style.ItemSpacing.y;
    wanted += ImGui::CalcTextSize(text::format(*shown.front()).c_str(), nullptr, false, wrap).y;
    height = std::max(height, std::min(wanted, screen.y * 0.6f));
  }
  ImGui::SetNextWindowPos({8, screen.y - height - 8}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({screen.x - 16, height}, ImGuiCond_Always);
  bool stays = true;
  ImGui::Begin("Log", &stays,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
  ImGui::PushTextWrapPos(0);
  if (lastGood) ImGui::TextColored({1, 0.7f, 0.3f, 1}, "%s", lastGood);
  for (const text::Diagnostic* each : shown) {
    const ImVec4 color = each->severity == text::Severity::error     ? ImVec4(1, 0.45f, 0.4f, 1)
                         : each->severity == text::Severity::warning ? ImVec4(1, 0.85f, 0.4f, 1)
                                                                     : ImVec4(0.7f, 0.7f, 0.7f, 1);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text::format(*each).c_str());
    ImGui::PopStyleColor();
  }
  ImGui::PopTextWrapPos();
  ImGui::End();
  if (!stays) log_.dismiss();
}

void Panels::drawLoading() {
  const std::optional<LoadStatus> all[] = {live_.environment().status(), live_.scene().status()};
  if (!all[0] && !all[1]) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float width = std::min(420.0f * ImGui::GetIO().FontGlobalScale, screen.x - 16);
  // Between the panels, which end at three quarters, and the log.
  ImGui::SetNextWindowPos({screen.x * 0.5f, screen.y * 0.8f - 12}, ImGuiCond_Always, {0.5f, 1});
  ImGui::SetNextWindowSize({width, 0}, ImGuiCond_Always);
  ImGui::Begin("Loading", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoSavedSettings);
  for (const auto& status : all) {
    if (!status) continue;
    ImGui::TextUnformatted(fmt::format("{}: {}", status->name, status->stage).c_str());
    ImGui::ProgressBar(status->done, {-1, 0}, fmt::format("{:.0f} %", status->done * 100.0f).c_str());
  }
  ImGui::End();
}

}  // namespace weft::app::ui
