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

void explain(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

}  // namespace

void Panels::drawPasses(base::Diagnostics& diagnostics) {
  if (explained_ != live_.switches()) return;  // a parameter has just replaced the plan: in the next frame
  runtime::Execution& execution = *renderer_.execution();
  const graph::Plan& plan = execution.plan();
  const graph::FlatGraph& graph = *plan.graph;
  gl::PassTimers& timers = renderer_.device().timers;
  bool profile = timers.enabled();
  if (ImGui::Checkbox("measure each pass", &profile)) timers.setEnabled(profile);
  std::string pass;  // to turn on or off when all is drawn
  bool enable = false;

  // Little room: whether a pass ran shows in the colour of its name, CPU times only in the tooltip.
  const bool narrow = ImGui::GetContentRegionAvail().x < ImGui::GetFontSize() * 24;
  const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit;
  if (ImGui::BeginTable("passes", narrow ? (profile ? 2 : 1) : (profile ? 4 : 2), flags)) {
    ImGui::TableSetupColumn("in the order they run", ImGuiTableColumnFlags_WidthStretch);
    if (!narrow) ImGui::TableSetupColumn("");
    if (profile) ImGui::TableSetupColumn("GPU ms");
    if (profile && !narrow) ImGui::TableSetupColumn("CPU ms");
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(plan.steps.size()));
    while (clipper.Step())
      for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
        const auto step = static_cast<std::size_t>(row);
        const std::uint32_t index = plan.steps[step].pass;
        const std::string& name = graph.passNames[index];
        const bool ran = execution.ran(name);
        const std::string slice = ran ? sliceText(execution.steps().slices(step)) : "";
        ImGui::PushID(row);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        bool on = true;
        if (!ran) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        if (ImGui::Checkbox(name.c_str(), &on)) pass = switchNameOf(graph, index);
        if (!ran) ImGui::PopStyleColor();
        const bool timed = profile && step < timers.results().size() && timers.results()[step].ran;
        explain(name +
                (timed ? fmt::format(": GPU {:.2f} ms, CPU {:.2f} ms", timers.results()[step].gpu,
                                     timers.results()[step].cpu)
                       : "") +
                "\n" + (slice.empty() ? "" : "slice " + slice + " of its work in this frame\n") +
                explainer_->whyPass(index) + "\n" + explainer_->whyHere(index) +
                (ran ? "" : "\nkept: nothing it depends on has changed since it ran"));
        if (!narrow) {
          ImGui::TableNextColumn();
          ran ? ImGui::TextUnformatted(slice.empty() ? "ran" : slice.c_str()) : ImGui::TextDisabled("kept");
        }
        if (timed) {
          ImGui::TableNextColumn();
          ImGui::Text("%6.2f", timers.results()[step].gpu);
          if (!narrow) ImGui::TableNextColumn();
          if (!narrow) ImGui::Text("%6.2f", timers.results()[step].cpu);
        }
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
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(why.c_str()).x) {
      ImGui::NewLine();
      ImGui::Indent();
      ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
      ImGui::TextWrapped("%s", why.c_str());
      ImGui::PopStyleColor();
      ImGui::Unindent();
    } else {
      ImGui::TextDisabled("%s", why.c_str());
    }
    ImGui::PopID();
  };
  for (std::uint32_t i = 0; i < graph.passes.size(); ++i)
    if (plan.stepOf[i] == graph::kNone) listIdle(graph.passNames[i], explainer_->whyPass(i), {});
  for (const graph::DisabledPass& each : graph.disabled)
    listIdle(each.name, each.why, disabledBy(each, live_.settings()));
  if (!pass.empty()) live_.setEnabled(pass, enable, diagnostics);
}

}  // namespace weft::app::ui
