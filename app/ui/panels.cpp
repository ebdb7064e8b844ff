#include "app/ui/panels.h"

#include <imgui.h>

#include <algorithm>

#include "app/ui/loading.h"

namespace weft::app::ui {

void Log::addPast(const base::Diagnostics& diagnostics) {
  for (const base::Diagnostic& each : diagnostics.items()) {
    const auto same = [&](const base::Diagnostic& old) {
      return old.code == each.code && old.message == each.message;
    };
    if (std::ranges::none_of(past, same)) past.push_back(each);
  }
  if (past.size() > 100) past.erase(past.begin(), past.end() - 100);
}

void Panels::draw(const runtime::FrameReport& report, base::Diagnostics& diagnostics) {
  if (explained_ != live_.switches() || !explainer_) {
    explainer_ = std::make_unique<graph::Explainer>(renderer_.execution()->plan());
    explained_ = live_.switches();
  }
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  if (visible) {
    const float scale = ImGui::GetIO().FontGlobalScale;
    const ImVec2 size(std::min(380.0f * scale, screen.x * 0.45f), std::max(64.0f, screen.y * 0.75f));
    ImGui::SetNextWindowPos({8, 8}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(size, ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Parameters")) {
      drawSummary(report);
      drawParameters(diagnostics);
    }
    ImGui::End();
    ImGui::SetNextWindowPos({screen.x - size.x - 8, 8}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(size, ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Passes")) drawPasses(diagnostics);
    ImGui::End();
  }
  const auto isError = [](const base::Diagnostic& each) { return each.severity == base::Severity::error; };
  const bool urgent =
      !log_.files.empty() || !log_.change.empty() || std::ranges::any_of(log_.environment, isError);
  if (urgent || (visible && (!log_.past.empty() || !log_.environment.empty()))) drawLog();
  drawLoading(live_.environment());
}

void Panels::drawSummary(const runtime::FrameReport& report) {
  const ImGuiIO& io = ImGui::GetIO();
  const graph::Settings& settings = live_.settings();
  ImGui::Text("%ux%u, %.1f ms a frame, %u passes run, %u skipped", settings.screenWidth,
              settings.screenHeight, 1000.0 / std::max(1e-3, static_cast<double>(io.Framerate)),
              report.passesRun, report.passesSkipped);
  ImGui::TextDisabled("%s", renderer_.graphPath().c_str());
  ImGui::TextDisabled("F1: help");
}

void Panels::drawLog() const {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float height = std::max(64.0f, screen.y * 0.2f);
  ImGui::SetNextWindowPos({8, screen.y - height - 8}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({screen.x - 16, height}, ImGuiCond_Always);
  ImGui::Begin("Log", nullptr,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse);
  if (!live_.good())
    ImGui::TextColored({1, 0.7f, 0.3f, 1}, "This is the last good picture; the files on disk have errors:");
  for (const auto* list : {&log_.files, &log_.environment, &log_.change, &log_.past})
    for (const base::Diagnostic& each : *list) {
      const ImVec4 color = each.severity == base::Severity::error     ? ImVec4(1, 0.45f, 0.4f, 1)
                           : each.severity == base::Severity::warning ? ImVec4(1, 0.85f, 0.4f, 1)
                                                                      : ImVec4(0.7f, 0.7f, 0.7f, 1);
      ImGui::PushStyleColor(ImGuiCol_Text, color);
      ImGui::PushTextWrapPos(0);
      ImGui::TextUnformatted(base::format(each).c_str());
      ImGui::PopTextWrapPos();
      ImGui::PopStyleColor();
    }
  ImGui::End();
}

}  // namespace weft::app::ui
