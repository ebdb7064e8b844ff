// Which physical texture, or which bytes of the arena, hold which resource over the steps of the frame; and how bright the
// picture is. Declared in panels.h.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/ui/luminance_plot.h"
#include "app/ui/panels.h"
#include "engine/base/hash.h"

namespace weft::app::ui {

namespace {

std::string bytesText(std::uint64_t bytes) {
  if (bytes >= 1 << 20) return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1 << 20));
  if (bytes >= 1 << 10) return fmt::format("{:.1f} KiB", static_cast<double>(bytes) / (1 << 10));
  return fmt::format("{} B", bytes);
}

std::string describe(const graph::Storage& storage) {
  std::string text =
      fmt::format("{} {}x{}", graph::infoOf(storage.format).name, storage.width, storage.height);
  if (storage.depth > 1) text += fmt::format("x{}", storage.depth);
  if (storage.layers > 1) text += fmt::format(" layers {}", storage.layers);
  if (storage.mips > 1) text += fmt::format(" mips {}", storage.mips);
  if (storage.copies > 1) text += fmt::format(" copies {}", storage.copies);
  return text;
}

struct Row {
  std::string name, bytes;
  std::vector<std::uint32_t> resources;
};

std::vector<Row> rowsOf(const graph::Plan& plan) {
  std::vector<Row> rows;
  for (const graph::Storage& storage : plan.storages)
    rows.push_back({describe(storage), bytesText(storage.bytes), {}});
  for (std::uint32_t r = 0; r < plan.graph->resources.size(); ++r) {
    if (plan.firstStep[r] == graph::kNone) continue;
    if (plan.storageOf[r] != graph::kNone) {
      rows[plan.storageOf[r]].resources.push_back(r);
    } else if (plan.graph->resources[r].kind == graph::ResourceKind::buffer) {
      const bool transient = plan.bufferOffsetOf[r] != graph::Plan::kNoOffset;
      rows.push_back({transient ? fmt::format("arena + {}", plan.bufferOffsetOf[r]) : "buffer of its own",
                      bytesText(plan.graph->resources[r].bytes),
                      {r}});
    }
  }
  return rows;
}

}  // namespace

void Panels::drawStorage() {
  if (explained_ != live_.switches()) return;  // a parameter has just replaced the plan: in the next frame
  const graph::Plan& plan = renderer_.execution()->plan();
  const graph::FlatGraph& graph = *plan.graph;
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s in %zu textures; each resource by itself: %s; the least possible: %s",
                      bytesText(plan.bytesAllocated).c_str(), plan.storages.size(),
                      bytesText(plan.bytesDeclared).c_str(), bytesText(plan.bytesLowerBound).c_str());
  ImGui::PopTextWrapPos();
  const ImGuiTableFlags flags =
      ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersInnerV;
  if (!ImGui::BeginTable("storage", 3, flags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("storage");
  ImGui::TableSetupColumn("bytes");
  ImGui::TableSetupColumn("steps of the frame", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableHeadersRow();
  const float line = ImGui::GetTextLineHeight();
  const auto steps = static_cast<float>(std::max<std::size_t>(1, plan.steps.size()));
  int id = 0;
  for (const Row& row : rowsOf(plan)) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.name.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.bytes.c_str());
    ImGui::TableNextColumn();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(16.0f, ImGui::GetContentRegionAvail().x);
    ImGui::PushID(id++);
    ImGui::InvisibleButton("bar", {width, line});
    ImGui::PopID();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + width, corner.y + line}, IM_COL32(30, 30, 36, 255));
    for (const std::uint32_t r : row.resources) {
      const std::string& name = graph.resourceNames[r];
      const std::uint32_t last =
          std::min(plan.lastStep[r], static_cast<std::uint32_t>(plan.steps.size()) - 1);
      // What persists holds its contents for the whole frame; its uses stand out.
      const bool kept = plan.persistent[r] != 0;
      const ImVec2 from(corner.x + width * static_cast<float>(plan.firstStep[r]) / steps, corner.y + 1);
      const ImVec2 to(corner.x + width * static_cast<float>(last + 1) / steps - 1, corner.y + line - 1);
      const float hue = static_cast<float>(base::hashBytes(name, base::kHashSeed) % 997) / 997.0f;
      if (kept)
        draw.AddRectFilled({corner.x, corner.y + 1}, {corner.x + width, corner.y + line - 1},
                           ImColor::HSV(hue, 0.4f, 0.35f));
      draw.AddRectFilled(from, to, ImColor::HSV(hue, 0.5f, 0.6f));
      if (ImGui::CalcTextSize(name.c_str()).x + 4 <= to.x - from.x)
        draw.AddText({from.x + 3, from.y - 1}, IM_COL32(255, 255, 255, 255), name.c_str());
      const ImVec2 mouse = ImGui::GetIO().MousePos;
      if (!ImGui::IsItemHovered() || mouse.x < (kept ? corner.x : from.x) ||
          mouse.x > (kept ? corner.x + width : to.x))
        continue;
      const auto passName = [&](std::uint32_t step) { return graph.passNames[plan.steps[step].pass]; };
      ImGui::BeginTooltip();
      ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
      ImGui::TextUnformatted(fmt::format("{}: {}\nfrom step {} ({}) to step {} ({})\n{}", name,
                                         bytesText(graph.resources[r].bytes), plan.firstStep[r],
                                         passName(std::min(plan.firstStep[r], last)), last, passName(last),
                                         explainer_->whyStorage(r))
                                 .c_str());
      ImGui::PopTextWrapPos();
      ImGui::EndTooltip();
    }
  }
  ImGui::EndTable();
}

void Panels::drawHistogram(base::Diagnostics& diagnostics) {
  runtime::Execution& execution = *renderer_.execution();
  const auto& parameters = execution.plan().graph->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const graph::ParameterSpec& parameter = parameters[i];
    if (parameter.desc.type != graph::ParameterDesc::Type::boolean || !isCalled(parameter.path, "histogram"))
      continue;
    bool on = execution.uniforms().parameters()[i].truth();
    if (!ImGui::Checkbox("before the tone curve", &on)) break;
    live_.setParameter(parameter.path, graph::Value::boolean(on), diagnostics);
    return;  // with another plan: in the next frame
  }
  if (drawLuminance(execution)) return;
  ImGui::TextDisabled("the picture as presented, 8-bit values");
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 area(std::max(32.0f, ImGui::GetContentRegionAvail().x),
                    std::max(32.0f, ImGui::GetContentRegionAvail().y));
  ImGui::InvisibleButton("bins", area);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(corner, {corner.x + area.x, corner.y + area.y}, IM_COL32(16, 16, 18, 255));
  const auto& bins = histogram_.bins();
  // The ends may hold a whole sky: the scale is that of what lies between.
  float highest = 1e-4f;
  for (const auto& channel : bins)
    for (std::size_t i = 1; i < 255; ++i) highest = std::max(highest, channel[i]);
  static constexpr ImU32 kColors[] = {IM_COL32(220, 60, 60, 110), IM_COL32(60, 200, 80, 110),
                                      IM_COL32(70, 110, 240, 110), IM_COL32(235, 235, 235, 150)};
  const float bar = area.x / 256;
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t i = 0; i < 256; ++i) {
      const float height = area.y * std::min(1.0f, bins[c][i] / highest);
      const float x = corner.x + bar * static_cast<float>(i);
      if (height > 0)
        draw.AddRectFilled({x, corner.y + area.y - height}, {x + std::max(1.0f, bar), corner.y + area.y},
                           kColors[c]);
    }
  if (!ImGui::IsItemHovered()) return;
  const auto at =
      static_cast<std::size_t>(std::clamp((ImGui::GetIO().MousePos.x - corner.x) / bar, 0.0f, 255.0f));
  ImGui::SetTooltip("%zu: red %.2f %%, green %.2f %%, blue %.2f %%, luminance %.2f %%", at,
                    bins[0][at] * 100.0, bins[1][at] * 100.0, bins[2][at] * 100.0, bins[3][at] * 100.0);
}

}  // namespace weft::app::ui
