// One widget per parameter of the graph, made from what the graph says about it.
#include <imgui.h>

#include <algorithm>
#include <optional>
#include <string>

#include "app/ui/panels.h"

namespace weft::app::ui {

namespace {

using graph::ParameterDesc;
using graph::Value;
using Type = ParameterDesc::Type;

std::optional<Value> editNumber(const char* label, const graph::ParameterSpec& parameter) {
  const ParameterDesc& desc = parameter.desc;
  const bool ranged = desc.min && desc.max;
  if (desc.type == Type::integer) {
    int x = static_cast<int>(parameter.value.v[0]);
    const int low = desc.min ? static_cast<int>(*desc.min) : INT32_MIN / 2, high = desc.max ? static_cast<int>(*desc.max) : INT32_MAX / 2;
    const bool edited = ranged ? ImGui::SliderInt(label, &x, low, high, "%d", ImGuiSliderFlags_AlwaysClamp)
                               : ImGui::DragInt(label, &x, 0.1f, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
    return edited ? std::optional(Value::number(x)) : std::nullopt;
  }
  double x = parameter.value.v[0];
  const double low = desc.min.value_or(-1e9), high = desc.max.value_or(1e9);
  const bool edited =
      ranged ? ImGui::SliderScalar(label, ImGuiDataType_Double, &x, &low, &high, "%.4g", ImGuiSliderFlags_AlwaysClamp)
             : ImGui::DragScalar(label, ImGuiDataType_Double, &x, static_cast<float>(desc.step.value_or(0.01)), &low, &high,
                                 "%.4g", ImGuiSliderFlags_AlwaysClamp);
  return edited ? std::optional(Value::number(x)) : std::nullopt;
}

std::optional<Value> editVector(const char* label, const graph::ParameterSpec& parameter) {
  Value value = parameter.value;
  const double low = parameter.desc.min.value_or(-1e9), high = parameter.desc.max.value_or(1e9);
  const bool edited = ImGui::DragScalarN(label, ImGuiDataType_Double, value.v.data(), value.count,
                                         static_cast<float>(parameter.desc.step.value_or(0.01)), &low, &high, "%.3g",
                                         ImGuiSliderFlags_AlwaysClamp);
  return edited ? std::optional(value) : std::nullopt;
}

std::optional<Value> editChoice(const char* label, const graph::ParameterSpec& parameter) {
  std::optional<Value> chosen;
  if (!ImGui::BeginCombo(label, parameter.value.symbol.c_str())) return chosen;
  for (const std::string& choice : parameter.desc.choices) {
    const bool current = choice == parameter.value.symbol;
    if (ImGui::Selectable(choice.c_str(), current) && !current) chosen = Value::text(choice);
  }
  ImGui::EndCombo();
  return chosen;
}

std::optional<Value> edit(const char* label, const graph::ParameterSpec& parameter) {
  switch (parameter.desc.type) {
    case Type::boolean: {
      bool on = parameter.value.truth();
      return ImGui::Checkbox(label, &on) ? std::optional(Value::boolean(on)) : std::nullopt;
    }
    case Type::integer:
    case Type::number: return editNumber(label, parameter);
    case Type::vec2:
    case Type::vec3:
    case Type::vec4: return editVector(label, parameter);
    case Type::choice: return editChoice(label, parameter);
    case Type::file: ImGui::LabelText(label, "%s", parameter.value.symbol.c_str()); return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

void Panels::drawParameters(base::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *renderer_.execution()->plan().graph;
  std::string changed, text, scope = "\n";
  ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.45f);
  for (const graph::ParameterSpec& parameter : graph.parameters) {
    const std::size_t dot = parameter.path.rfind('.');
    const std::string prefix = dot == std::string::npos ? std::string() : parameter.path.substr(0, dot);
    if (prefix != scope) {
      scope = prefix;
      if (!prefix.empty()) ImGui::TextDisabled("%s", prefix.c_str());
    }
    ImGui::PushID(parameter.path.c_str());
    const std::string& name = parameter.desc.label.empty() ? parameter.desc.name : parameter.desc.label;
    if (const auto value = edit(name.c_str(), parameter)) {
      changed = parameter.path;
      text = graph::toText(*value);
    }
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("%s = %s%s%s%s\nright click: as the files say", parameter.path.c_str(),
                        graph::toText(parameter.value).c_str(), parameter.structural ? "\nchanges the plan" : "",
                        parameter.desc.doc.empty() ? "" : "\n", parameter.desc.doc.c_str());
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) {
      changed = parameter.path;
      text = graph::toText(parameter.desc.initial);
    }
    ImGui::PopID();
  }
  ImGui::PopItemWidth();
  if (!changed.empty()) live_.setParameter(changed, text, diagnostics);
}

}  // namespace weft::app::ui
