// Which physical texture, or which bytes of the arena, hold which resource over
// the steps of the frame. Declared in panels.h.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

#include "app/ui/panels.h"
#include "engine/text/hash.h"

namespace weft::app::ui {

namespace {

std::string bytesText(std::uint64_t bytes) {
  if (bytes >= 1 << 20) return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1 << 20));
  if (bytes >= 1 << 10) return fmt::format("{:.1f} KiB", static_cast<double>(bytes) / (1 << 10));
  return fmt::format("{} B", bytes);
}

struct Row {
  std::string name, bytes;
  std::vector<std::uint32_t> resources;
};

std::vector<Row> rowsOf(const graph::Plan& plan) {
  std::vector<Row> rows;
  for (const graph::Storage& storage : plan.storages)
    rows.push_back(
        {shapeText(storage) + (storage.copies > 1 ? fmt::format(", {} copies", storage.copies) : ""),
         bytesText(storage.bytes),
         {}});
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
  const graph::Plan& plan = renderer_.execution()->plan();
  const graph::FlatGraph& graph = *plan.graph;
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s in %zu textures; each resource by itself: %s; the least possible: %s",
                      bytesText(plan.bytesAllocated).c_str(), plan.storages.size(),
                      bytesText(plan.bytesDeclared).c_str(), bytesText(plan.bytesLowerBound).c_str());
  ImGui::PopTextWrapPos();
  if (!beginTable("storage", {"storage", "bytes", "steps of the frame"}, 2,
                  ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV))
    return;
  const float line = ImGui::GetTextLineHeight();
  const auto steps = static_cast<float>(std::max<std::size_t>(1, plan.steps.size()));
  int id = 0;
  for (const Row& row : rowsOf(plan)) {
    ImGui::TableNextRow();
    cell(row.name);
    cell(row.bytes);
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
      const float hue = static_cast<float>(text::hashBytes(name, text::kHashSeed) % 997) / 997.0f;
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
      tooltip(fmt::format("{}: {}\nfrom step {} ({}) to step {} ({})\n{}", name,
                          bytesText(graph.resources[r].bytes), plan.firstStep[r],
                          passName(std::min(plan.firstStep[r], last)), last, passName(last),
                          explainer_->whyStorage(r)));
    }
  }
  ImGui::EndTable();
}

}  // namespace weft::app::ui
