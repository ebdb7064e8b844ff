// The passes in the order of the files, whether they run or not; effects have a box for all. Declared in panels.h.

#include "app/ui/panels.h"

namespace weft::app::ui {

void Panels::drawPasses(text::Diagnostics& diagnostics) {
  const bool profile = measureBox();
  ImGui::SameLine();
  passFilter_.Draw("search", -4 * em_);
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
  if (!(profile
            ? beginTable("passes", {"in the order of the files", "state   ", "GPU ms", "CPU ms"}, 0, kFlags)
            : beginTable("passes", {"in the order of the files", "state   "}, 0, kFlags)))
    return;
  std::vector<std::size_t> seen;
  ImGuiStorage& closed = *ImGui::GetStateStorage();
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    if (passFilter_.IsActive() && !passFilter_.PassFilter(rows_[row].name.c_str())) continue;
    seen.push_back(row);
    if (!passFilter_.IsActive() && closed.GetBool(ImGui::GetID(rows_[row].name.c_str())))
      row = rows_[row].end - 1;
  }
  const std::uint64_t changes = live_.changes();
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(seen.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd && live_.changes() == changes; ++i)
      drawPassRow(seen[static_cast<std::size_t>(i)], diagnostics);
  clipper.End();
  ImGui::EndTable();
}

void Panels::select(std::string_view pass) {
  const graph::Plan& plan = renderer_.execution()->plan();
  const auto at = std::ranges::find(plan.graph->passNames, pass);
  if (at == plan.graph->passNames.end()) return;
  const auto index = static_cast<std::uint32_t>(at - plan.graph->passNames.begin());
  const auto row = std::ranges::find_if(
      rows_, [&](const PassRow& each) { return std::ranges::find(each.passes, index) != each.passes.end(); });
  selected_ = static_cast<std::uint32_t>(row - rows_.begin());
  inspector_.select(plan, index);
  open("selected");
}

text::Place Panels::selectedPlace(bool shader) const {
  if (selected_ >= rows_.size()) return {};
  const PassRow& row = rows_[selected_];
  if (!shader) return row.desc->place;
  if (row.passes.empty()) return {};
  const graph::PassSpec& spec = renderer_.execution()->plan().graph->specs[row.passes.front()];
  glsl::SourceLoader& sources = renderer_.device().sources;
  text::Diagnostics ignored;
  const auto source = spec.shader.empty() ? nullptr : sources.load(spec.shader, ignored);
  return source ? source->placeOfMain() : text::Place{};
}

void Panels::drawPictures(text::Diagnostics& diagnostics) {
  std::uint32_t selected = graph::kNone;
  if (selected_ < rows_.size() && !rows_[selected_].passes.empty()) selected = rows_[selected_].passes.back();
  const graph::Plan& plan = renderer_.execution()->plan();
  if (const std::uint32_t pass = pictures_.draw(plan, selected, diagnostics); pass != graph::kNone)
    select(plan.graph->passNames[pass]);
}

void Panels::drawPassRow(std::size_t index, text::Diagnostics& diagnostics) {
  const PassRow& row = rows_[index];
  runtime::Execution& execution = *renderer_.execution();
  const graph::Plan& plan = execution.plan();
  const std::string parameter = switchParameterOf(row, *plan.graph), by = disabledBy(row, live_.settings());
  // What its instances did in this frame.
  std::string state = row.on == 0 ? "off" : "", tip = row.name;
  double gpu = 0, cpu = 0;
  bool ran = false, timed = false;
  for (std::size_t i = index; i < row.end; ++i)
    for (const std::uint32_t pass : rows_[i].passes) {
      const std::uint32_t step = plan.stepOf[pass];
      if (step == graph::kNone) {
        if (state.empty() && !row.effect()) state = "culled";
        continue;
      }
      const bool now = execution.steps().ran(step);
      ran |= now;
      const runtime::SliceRange range = execution.steps().slices(step);
      const bool sliced = range.of > 1 && range.count < range.of;
      if (now && !row.effect()) state = sliced ? fmt::format("{}/{}", range.first + 1, range.of) : "";
      const auto times = renderer_.device().timers.results();
      if (step >= times.size() || !times[step].ran) continue;
      timed = true;
      gpu += times[step].gpu;
      cpu += times[step].cpu;
    }
  if (state.empty()) state = ran ? "ran" : "kept";
  ImGuiStorage& closed = *ImGui::GetStateStorage();
  const ImGuiID key = ImGui::GetID(row.name.c_str());
  ImGui::PushID(row.name.c_str());
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  if (row.depth > 0) ImGui::Indent(static_cast<float>(row.depth) * em_);
  // Off, on, or some of what it includes.
  unsigned box = row.on == 0 ? 0 : row.off == 0 ? 3 : 1;
  const bool fixed = row.on == 0 && by.empty() && parameter.empty();
  ImGui::BeginDisabled(fixed);
  const bool clicked = ImGui::CheckboxFlags("##on", &box, 3u);
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (!ran) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  const std::string label = row.effect()            ? (closed.GetBool(key) ? "+ " : "- ") + row.label
                            : row.passes.size() > 1 ? fmt::format("{} x{}", row.label, row.passes.size())
                                                    : row.label;
  if (ImGui::Selectable(label.c_str(), selected_ == index)) {
    selected_ = static_cast<std::uint32_t>(index);
    if (row.effect()) {
      closed.SetBool(key, !closed.GetBool(key));
    } else if (!row.passes.empty() && plan.stepOf[row.passes.front()] != graph::kNone) {
      inspector_.select(plan, row.passes.front());
      wanted_.set(kSelected);
    }
  }
  const bool hovered = ImGui::IsItemHovered();
  if (!ran) ImGui::PopStyleColor();
  if (row.depth > 0) ImGui::Unindent(static_cast<float>(row.depth) * em_);
  if (hovered) {
    if (!row.passes.empty())
      tip += "\n" + explainer_->whyPass(row.passes.front()) + "\n" + explainer_->whyHere(row.passes.front());
    if (state == "kept") tip += "\nkept: nothing it depends on has changed since it ran";
    if (!by.empty() && row.on == 0)
      tip += "\noff: '" + by + "' is disabled here; the box takes that back";
    else if (!parameter.empty())
      tip += "\noff: needs " + parameter + " = true; the box sets it";
    else if (!row.why.empty())
      tip += "\noff: " + row.why;
    if (row.desc->place.file)
      tip += fmt::format("\n{}:{} (double click: in the editor)", std::string(*row.desc->place.file),
                         row.desc->place.line);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) edit_(row.desc->place);
    tooltip(tip, true);
  }
  cell(state);
  if (timed && renderer_.device().timers.enabled()) {
    cell(fmt::format("{:6.2f}", gpu));
    cell(fmt::format("{:6.2f}", cpu));
  }
  ImGui::PopID();
  if (!clicked) return;
  if (row.on > 0)
    live_.setEnabled(row.effect() ? row.name : switchNameOf(*plan.graph, row.passes.front()), false,
                     diagnostics);
  else if (!by.empty())
    live_.setEnabled(by, true, diagnostics);
  else
    live_.setParameter(parameter, graph::Value::boolean(true), diagnostics);
}

}  // namespace weft::app::ui
