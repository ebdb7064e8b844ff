// One widget per parameter of the graph, made from what the graph says about it.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "app/ui/panels.h"

namespace weft::app::ui {

namespace {

using graph::ParameterDesc;
using graph::Value;
using Type = ParameterDesc::Type;

// A number or a list of them. Dear ImGui asserts on wider ranges, and its whole numbers end at 2^30: those are edited as doubles, too.
std::optional<Value> editNumbers(const char* label, const ParameterDesc& desc, const Value& now) {
  constexpr double kWidest = std::numeric_limits<double>::max() / 2;
  const bool whole = desc.type == Type::integer, list = desc.type != Type::number && !whole;
  const double low = std::max(desc.min.value_or(-1e9), -kWidest),
               high = std::min(desc.max.value_or(1e9), kWidest);
  const char* format = whole ? "%.0f" : list ? "%.3g" : "%.4g";
  const int count = list ? static_cast<int>(now.count) : 1;
  const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp;
  const auto step = static_cast<float>(desc.step.value_or(whole ? 0.1 : 0.01));
  Value value = list ? now : Value::number(now.v[0]);
  double* const x = value.v.data();
  if (!(desc.min && desc.max && !list
            ? ImGui::SliderScalar(label, ImGuiDataType_Double, x, &low, &high, format, flags)
            : ImGui::DragScalarN(label, ImGuiDataType_Double, x, count, step, &low, &high, format, flags)))
    return std::nullopt;
  if (whole) *x = std::round(*x);
  return value;
}

// A list of three or four that its name calls a color, from 0 to 1.
bool isColor(const ParameterDesc& desc) {
  if ((desc.type != Type::vec3 && desc.type != Type::vec4) || desc.min != 0 || desc.max != 1) return false;
  const std::string names = desc.name + desc.label;
  for (const char* word : {"color", "colour", "Color", "Colour", "albedo", "tint"})
    if (names.find(word) != std::string::npos) return true;
  return false;
}

std::optional<Value> editColor(const char* label, const Value& now) {
  Value value = now;
  float color[4] = {0, 0, 0, 1};
  for (std::size_t i = 0; i < value.count; ++i) color[i] = static_cast<float>(value.v[i]);
  const ImGuiColorEditFlags flags = ImGuiColorEditFlags_Float;
  if (!(value.count == 4 ? ImGui::ColorEdit4(label, color, flags) : ImGui::ColorEdit3(label, color, flags)))
    return std::nullopt;
  for (std::size_t i = 0; i < value.count; ++i)
    value.v[i] = std::round(static_cast<double>(color[i]) * 1000) / 1000;
  return value;
}

std::optional<Value> editFile(const char* label, const Value& now) {
  char text[1024] = {};
  now.symbol.copy(text, sizeof text - 1);
  if (!ImGui::InputText(label, text, sizeof text, ImGuiInputTextFlags_EnterReturnsTrue)) return std::nullopt;
  return Value::text(text);
}

std::optional<Value> editChoice(const char* label, const ParameterDesc& desc, const Value& now) {
  std::optional<Value> chosen;
  if (!ImGui::BeginCombo(label, now.symbol.c_str())) return chosen;
  for (const std::string& choice : desc.choices) {
    const bool current = choice == now.symbol;
    if (ImGui::Selectable(choice.c_str(), current) && !current) chosen = Value::text(choice);
  }
  ImGui::EndCombo();
  return chosen;
}

std::optional<Value> edit(const char* label, const ParameterDesc& desc, const Value& now) {
  if (desc.type == Type::choice) return editChoice(label, desc, now);
  if (desc.type == Type::file) return editFile(label, now);
  if (desc.type != Type::boolean)
    return isColor(desc) ? editColor(label, now) : editNumbers(label, desc, now);
  bool on = now.truth();
  return ImGui::Checkbox(label, &on) ? std::optional(Value::boolean(on)) : std::nullopt;
}

}  // namespace

void Panels::drawParameters(const runtime::FrameReport& report, text::Diagnostics& diagnostics) {
  ImGui::TextWrapped("%ux%u, %u of %u passes ran", live_.settings().screenWidth,
                     live_.settings().screenHeight, report.passesRun,
                     report.passesRun + report.passesSkipped);
  ImGui::BeginDisabled(!live_.canUndo());
  if (ImGui::Button("undo")) act_("undo");
  ImGui::EndDisabled();
  ImGui::SameLine();
  ImGui::BeginDisabled(!live_.canRedo());
  if (ImGui::Button("redo")) act_("redo");
  ImGui::EndDisabled();
  ImGui::SameLine();
  filter_.Draw("search", -4 * em_);
  // After the buttons, which may make another plan.
  const graph::FlatGraph& graph = *renderer_.execution()->plan().graph;
  const std::span<const Value> values = renderer_.execution()->uniforms().parameters();
  if (!ImGui::BeginTable(
          "list", 2,
          ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_NoPadOuterX))
    return;
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_None, 0.42f);
  ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_None, 0.58f);
  std::optional<Value> changedTo;
  std::string changed, reset, scope;
  for (std::size_t i = 0; i < graph.parameters.size(); ++i) {
    const graph::ParameterSpec& parameter = graph.parameters[i];
    const Value& now = values[i];
    const std::string& label = parameter.desc.label.empty() ? parameter.desc.name : parameter.desc.label;
    if (!filter_.PassFilter(parameter.path.c_str()) && !filter_.PassFilter(label.c_str())) continue;
    const std::size_t dot = parameter.path.rfind('.');
    const std::string prefix = dot == std::string::npos ? std::string() : parameter.path.substr(0, dot);
    if (std::exchange(scope, prefix) != prefix) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", prefix.c_str());
    }
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(parameter.path.c_str());
    const bool tweaked = live_.isChanged(parameter.path);
    if (tweaked) ImGui::PushStyleColor(ImGuiCol_Text, {1, 0.85f, 0.4f, 1});
    ImGui::SetNextItemWidth(-1);
    if (auto value = edit("##value", parameter.desc, now)) {
      changed = parameter.path;
      changedTo = std::move(value);
    }
    bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked(ImGuiMouseButton_Right);
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextWrapped("%s%s", tweaked ? "* " : "", label.c_str());
    hovered |= ImGui::IsItemHovered();
    clicked |= ImGui::IsItemClicked(ImGuiMouseButton_Right);
    if (tweaked) ImGui::PopStyleColor();
    const ParameterDesc& desc = parameter.desc;
    tooltip(
        label + "\n" + parameter.path + " = " + graph::toText(now) +
            (desc.min && desc.max ? fmt::format("\n{} to {}; Ctrl click types a value", *desc.min, *desc.max)
                                  : "") +
            (parameter.structural ? "\nmakes another plan" : "") + (desc.doc.empty() ? "" : "\n") + desc.doc +
            (tweaked ? "\n* changed here; a right click goes back to what the files say" : ""),
        hovered);
    if (tweaked && clicked) reset = parameter.path;
    ImGui::PopID();
  }
  ImGui::EndTable();
  if (changedTo)
    live_.setParameter(changed, *changedTo, diagnostics);
  else if (!reset.empty())
    live_.resetParameter(reset, diagnostics);
}

}  // namespace weft::app::ui
