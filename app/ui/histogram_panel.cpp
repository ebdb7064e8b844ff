// How bright the picture is: the scene's luminance as the outputs of graphs/post.json have it, `histogram` over stops with
// a marker at the mean of `exposure`; or else the presented picture. Declared in panels.h.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/ui/panels.h"

namespace weft::app::ui {

namespace {

// shaders/exposure/histogram.glsl
constexpr double kBrightest = 16, kBinsPerStop = 8;

// Whether a dotted name ends in `name`: "post.histogram" is called "histogram".
bool isCalled(std::string_view dotted, std::string_view name) {
  return dotted == name || (dotted.ends_with(name) && dotted[dotted.size() - name.size() - 1] == '.');
}

const runtime::Output* find(const runtime::Execution& execution, std::string_view name, std::size_t least) {
  for (const runtime::Output& output : execution.readBack().outputs())
    if (output.arrived && output.count() >= least && isCalled(output.name, name)) return &output;
  return nullptr;
}

// Bars over what is left of the window.
class Plot {
 public:
  explicit Plot(std::size_t bins)
      : corner_(ImGui::GetCursorScreenPos()),
        area_(std::max(32.0f, ImGui::GetContentRegionAvail().x),
              std::max(32.0f, ImGui::GetContentRegionAvail().y)),
        bins_(bins),
        bar_(area_.x / static_cast<float>(bins)) {
    ImGui::InvisibleButton("bins", area_);
    fill(corner_.x, 1, area_.x, IM_COL32(16, 16, 18, 255));
  }
  // `height`: 0 to 1.
  void bar(std::size_t bin, double height, ImU32 color) const {
    if (height > 0)
      fill(corner_.x + bar_ * static_cast<float>(bin), static_cast<float>(height), std::max(1.0f, bar_),
           color);
  }
  void line(double bin, ImU32 color, float width = 1) const {
    const float x = corner_.x + bar_ * static_cast<float>(std::clamp(bin, 0.0, static_cast<double>(bins_)));
    ImGui::GetWindowDrawList()->AddLine({x, corner_.y}, {x, corner_.y + area_.y}, color, width);
  }
  std::size_t pointed() const {
    return static_cast<std::size_t>(
        std::clamp((ImGui::GetIO().MousePos.x - corner_.x) / bar_, 0.0f, static_cast<float>(bins_ - 1)));
  }

 private:
  void fill(float x, float height, float width, ImU32 color) const {
    const float bottom = corner_.y + area_.y, top = bottom - area_.y * std::min(1.0f, height);
    ImGui::GetWindowDrawList()->AddRectFilled({x, top}, {x + width, bottom}, color);
  }

  ImVec2 corner_, area_;
  std::size_t bins_;
  float bar_;
};

// False, and nothing drawn, when the graph has no such histogram or none has arrived.
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
  const Plot plot(bins);
  const auto binOf = [&](double stops) { return (stops - darkest) * kBinsPerStop + 1.5; };
  for (int stops = -12; stops <= 12; stops += 4)
    plot.line(binOf(stops), stops == 0 ? IM_COL32(110, 110, 120, 255) : IM_COL32(48, 48, 54, 255));
  for (std::size_t i = 1; i < bins && highest > 0; ++i)
    plot.bar(i, histogram->number(i) / highest, IM_COL32(235, 235, 235, 170));
  if (adapted) plot.line(binOf(std::log2(exposure->number(2))), IM_COL32(250, 170, 60, 255), 2);
  if (!ImGui::IsItemHovered()) return true;
  const std::size_t at = plot.pointed();
  const double share = total > 0 ? histogram->number(at) / total * 100 : 0;
  if (at == 0)
    ImGui::SetTooltip("black: %.2f %%", share);
  else
    ImGui::SetTooltip("%+.3f stops: %.2f %%", (static_cast<double>(at) - 1) / kBinsPerStop + darkest, share);
  return true;
}

}  // namespace

void Panels::drawHistogram() {
  if (drawLuminance(*renderer_.execution())) return;
  ImGui::TextDisabled("the picture as presented, 8-bit values");
  const auto& bins = histogram_.bins();
  // The ends may hold a whole sky: the scale is that of what lies between.
  float highest = 1e-4f;
  for (const auto& channel : bins)
    for (std::size_t i = 1; i < 255; ++i) highest = std::max(highest, channel[i]);
  static constexpr ImU32 kColors[] = {IM_COL32(220, 60, 60, 110), IM_COL32(60, 200, 80, 110),
                                      IM_COL32(70, 110, 240, 110), IM_COL32(235, 235, 235, 150)};
  const Plot plot(256);
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t i = 0; i < 256; ++i) plot.bar(i, static_cast<double>(bins[c][i] / highest), kColors[c]);
  if (!ImGui::IsItemHovered()) return;
  const std::size_t at = plot.pointed();
  ImGui::SetTooltip("%zu: red %.2f %%, green %.2f %%, blue %.2f %%, luminance %.2f %%", at,
                    bins[0][at] * 100.0, bins[1][at] * 100.0, bins[2][at] * 100.0, bins[3][at] * 100.0);
}

}  // namespace weft::app::ui
