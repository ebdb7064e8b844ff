// How bright the picture is: the scene's luminance as the outputs of graphs/post.json have it, `histogram` over stops; or else
// the presented picture. Declared in panels.h.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "app/ui/panels.h"
#include "engine/graph/language/suffix.h"

namespace weft::app::ui {

namespace {

// shaders/exposure/histogram.glsl
constexpr double kBrightest = 16, kBinsPerStop = 8;

const runtime::Output* find(const runtime::Execution& execution, std::string_view name, std::size_t least) {
  for (const runtime::Output& output : execution.readBack().outputs())
    if (output.arrived && output.count() >= least && graph::hasSuffix(output.name, name)) return &output;
  return nullptr;
}

// A bar for each bin, over `share` of what is left of the window. The tallest of all but the ends, which may hold a whole sky, is
// as high as the plot.
void drawBars(const char* name, std::span<const float> bins, ImU32 color, float share) {
  const float highest = std::max(1e-4f, std::ranges::max(bins.subspan(1, bins.size() - 2)));
  const ImVec2 room = ImGui::GetContentRegionAvail();
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, color);
  ImGui::PushID(name);
  ImGui::PlotHistogram("##bins", bins.data(), static_cast<int>(bins.size()), 0, name, 0, highest,
                       {room.x, std::max(32.0f, room.y * share)});
  ImGui::PopID();
  ImGui::PopStyleColor();
}

// False, and nothing drawn, when the graph has no such histogram or none has arrived.
bool drawLuminance(runtime::Execution& execution) {
  execution.readBack().collect();
  const runtime::Output* histogram = find(execution, "histogram", 3);
  if (!histogram) return false;
  const std::size_t count = histogram->count();  // the first is black
  const runtime::Output* exposure = find(execution, "exposure", 4);
  if (exposure && exposure->number(0) > 0 && exposure->number(2) > 0)
    ImGui::TextDisabled("exposure %+.2f EV, on its way to %+.2f; mean luminance %.3g, %+.2f stops",
                        std::log2(exposure->number(0)), std::log2(exposure->number(1)), exposure->number(2),
                        std::log2(exposure->number(2)));
  std::vector<float> shares(count);
  double total = 0;
  for (std::size_t i = 0; i < count; ++i) total += histogram->number(i);
  for (std::size_t i = 0; i < count && total > 0; ++i)
    shares[i] = static_cast<float>(histogram->number(i) / total);
  const std::string name =
      fmt::format("luminance of the scene: black, then {} to {} stops from 1",
                  kBrightest - static_cast<double>(count - 2) / kBinsPerStop, kBrightest);
  drawBars(name.c_str(), shares, IM_COL32(235, 235, 235, 170), 1);
  return true;
}

}  // namespace

void Panels::drawHistogram() {
  if (drawLuminance(*renderer_.execution())) return;
  // Again after a while, so that a picture at rest has its own; in idle mode that is drawn for longer.
  if (ImGui::GetTime() - counted_ > 0.1) {
    histogram_.update(renderer_.execution()->presented());
    counted_ = ImGui::GetTime();
  }
  ImGui::TextDisabled("the picture as presented, 8-bit values");
  static constexpr const char* kNames[] = {"red", "green", "blue", "luminance"};
  static constexpr ImU32 kColors[] = {IM_COL32(220, 60, 60, 255), IM_COL32(60, 200, 80, 255),
                                      IM_COL32(70, 110, 240, 255), IM_COL32(235, 235, 235, 255)};
  for (std::size_t c = 0; c < 4; ++c)
    drawBars(kNames[c], histogram_.bins()[c], kColors[c], 1 / static_cast<float>(4 - c));
}

}  // namespace weft::app::ui
