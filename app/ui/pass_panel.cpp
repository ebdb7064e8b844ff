// Passes in the order they run; below, those that do not, and why. Declared in panels.h.
#include <fmt/format.h>
#include <imgui.h>

#include <string>

#include "app/ui/panels.h"
#include "app/ui/pass_switch.h"

namespace weft::app::ui {

namespace {

// "3/24" of a pass that runs in slices, else nothing.
std::string sliceText(const runtime::SliceRange& range) {
  return range.of > 1 && range.count < range.of ? fmt::format("{}/{}", range.first + 1, range.of)
                                                : std::string();
}

}  // namespace

void Panels::drawPasses(text::Diagnostics& diagnostics) {
  if (explained_ != live_.switches()) return;  // a parameter has just replaced the plan: in the next frame
  runtime::Execution& execution = *renderer_.execution();
  const graph::Plan& plan = execution.plan();
  const graph::FlatGraph& graph = *plan.graph;
  const gl::PassTimers& timers = renderer_.device().timers;
  const bool profile = measureBox();
  std::string pass;  // to turn on or off when all is drawn
  bool enable = false;

  constexpr const char* kOrder = "in the order they run";
  if (profile ? beginTable("passes", {kOrder, "", "GPU ms", "CPU ms"}, 0, ImGuiTableFlags_RowBg)
              : beginTable("passes", {kOrder, ""}, 0, ImGuiTableFlags_RowBg)) {
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(plan.steps.size()));
    while (clipper.Step())
      for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
        const auto step = static_cast<std::size_t>(row);
        const std::uint32_t index = plan.steps[step].pass;
        const std::string& name = graph.passNames[index];
        const bool ran = execution.steps().ran(step);
        const std::string slice = ran ? sliceText(execution.steps().slices(step)) : "";
        ImGui::PushID(row);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        bool on = true;
        if (!ran) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        if (ImGui::Checkbox(name.c_str(), &on)) pass = switchNameOf(graph, index);
        if (!ran) ImGui::PopStyleColor();
        const bool timed = profile && step < timers.results().size() && timers.results()[step].ran;
        tooltip(name + "\n" + (slice.empty() ? "" : "slice " + slice + " of its work in this frame\n") +
                explainer_->whyPass(index) + "\n" + explainer_->whyHere(index) +
                (ran ? "" : "\nkept: nothing it depends on has changed since it ran"));
        ImGui::TableNextColumn();
        ran ? ImGui::TextUnformatted(slice.empty() ? "ran" : slice.c_str()) : ImGui::TextDisabled("kept");
        if (timed) cell(fmt::format("{:6.2f}", timers.results()[step].gpu));
        if (timed) cell(fmt::format("{:6.2f}", timers.results()[step].cpu));
        ImGui::PopID();
      }
    ImGui::EndTable();
  }

  const auto listIdle = [&](const std::string& name, const std::string& why, const std::string& option) {
    bool off = false;
    ImGui::PushID(name.c_str());
    ImGui::BeginDisabled(option.empty());
    if (ImGui::Checkbox(name.c_str(), &off)) {
      pass = option;
      enable = true;
    }
    ImGui::EndDisabled();
    ImGui::Indent();
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextWrapped("%s", why.c_str());
    ImGui::PopStyleColor();
    ImGui::Unindent();
    ImGui::PopID();
  };
  for (std::uint32_t i = 0; i < graph.passes.size(); ++i)
    if (plan.stepOf[i] == graph::kNone) listIdle(graph.passNames[i], explainer_->whyPass(i), {});
  for (const graph::DisabledPass& each : graph.disabled)
    listIdle(each.name, each.why, disabledBy(each, live_.settings()));
  if (!pass.empty()) live_.setEnabled(pass, enable, diagnostics);
}

}  // namespace weft::app::ui
