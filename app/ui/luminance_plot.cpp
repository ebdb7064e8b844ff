#include "app/ui/luminance_plot.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace weft::app::ui {

namespace {

// shaders/exposure/histogram.glsl
constexpr double kBrightest = 16, kBinsPerStop = 8;

const runtime::Output* find(const runtime::Execution& execution, std::string_view name, std::size_t least) {
  for (const runtime::Output& output : execution.readBack().outputs())
    if (output.arrived && output.count() >= least && isCalled(output.name, name)) return &output;
  return nullptr;
}

}  // namespace

bool isCalled(std::string_view dotted, std::string_view name) {
  return dotted == name || (dotted.ends_with(name) && dotted[dotted.size() - name.size() - 1] == '.');
}

bool drawLuminance(runtime::Execution& execution) {
  execution.readBack().collect();
  const runtime::Output* histogram = find(execution, "histogram", 3);
  if (!histogram) return false;
  const std::size_t bins = histogram->count();  // the first is black
  const double darkest = kBrightest - static_cast<double>(bins - 2) / kBinsPerStop;
  const runtime::Output* exposure = find(execution, "exposure", 4);
  const bool adapted = exposure && exposure->number(0) > 0 && exposure->number(2) > 0;
  if (adapted)
    ImGui::TextDisabled("exposure %+.2f EV, on its way to %+.2f; mean luminance %.3g",
                        std::log2(exposure->number(0)), std::log2(exposure->number(1)), exposure->number(2));
  else
    ImGui::TextDisabled("luminance of the scene, in stops from 1");
  double total = 0, highest = 0;
  for (std::size_t i = 0; i < bins; ++i) {
    total += histogram->number(i);
    if (i > 0) highest = std::max(highest, histogram->number(i));
  }
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 area(std::max(32.0f, ImGui::GetContentRegionAvail().x),
                    std::max(32.0f, ImGui::GetContentRegionAvail().y));
  ImGui::InvisibleButton("stops", area);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float bottom = corner.y + area.y, bar = area.x / static_cast<float>(bins);
  draw.AddRectFilled(corner, {corner.x + area.x, bottom}, IM_COL32(16, 16, 18, 255));
  const auto placeOf = [&](double stops) {
    return corner.x + bar * static_cast<float>(std::clamp((stops - darkest) * kBinsPerStop + 1.5, 0.0,
                                                          static_cast<double>(bins)));
  };
  for (int stops = -12; stops <= 12; stops += 4)
    draw.AddLine({placeOf(stops), corner.y}, {placeOf(stops), bottom},
                 stops == 0 ? IM_COL32(110, 110, 120, 255) : IM_COL32(48, 48, 54, 255));
  for (std::size_t i = 1; i < bins && highest > 0; ++i) {
    const float height = area.y * static_cast<float>(histogram->number(i) / highest);
    const float x = corner.x + bar * static_cast<float>(i);
    if (height > 0)
      draw.AddRectFilled({x, bottom - height}, {x + std::max(1.0f, bar), bottom},
                         IM_COL32(235, 235, 235, 170));
  }
  if (adapted) {
    const float mean = placeOf(std::log2(exposure->number(2)));
    draw.AddLine({mean, corner.y}, {mean, bottom}, IM_COL32(250, 170, 60, 255), 2);
  }
  if (!ImGui::IsItemHovered()) return true;
  const auto at = static_cast<std::size_t>(
      std::clamp((ImGui::GetIO().MousePos.x - corner.x) / bar, 0.0f, static_cast<float>(bins - 1)));
  const double share = total > 0 ? histogram->number(at) / total * 100 : 0;
  if (at == 0)
    ImGui::SetTooltip("black: %.2f %%", share);
  else
    ImGui::SetTooltip("%+.3f stops: %.2f %%", (static_cast<double>(at) - 1) / kBinsPerStop + darkest, share);
  return true;
}

}  // namespace weft::app::ui
