#include "app/ui/pixel_panel.h"

#include <algorithm>
#include <cmath>

#include "app/ui/panels.h"

namespace weft::app::ui {

void PixelPanel::afterStep(runtime::Execution& execution, std::uint32_t step) {
  const gl::TextureDesc picture = execution.presented().desc;
  if (!place_ || !execution.steps().hasResults(step)) return;
  const graph::Plan& plan = execution.plan();
  plan.forEachWrite(step, [&](const graph::FlatUse& use) {
    if (plan.graph->resources[use.resource].kind != graph::ResourceKind::texture) return;
    const gl::TextureRef texture = execution.texture(use.resource);
    const gl::Extent size = gl::extentOf(texture.desc, use.mip);
    // Of the same shape, but for what rounding takes from a smaller one. Small levels of anything are alike.
    const auto across = static_cast<double>(texture.desc.width) * picture.height,
               along = static_cast<double>(texture.desc.height) * picture.width;
    if (texture.desc.samples > 1 || std::abs(across - along) > picture.width + picture.height) return;
    const auto at = [](double share, std::uint32_t count) {
      return std::min(static_cast<std::uint32_t>(share * count), count - 1);
    };
    const std::uint32_t x = at(place_->x, size.width), y = at(place_->y, size.height);
    Row row{.pass = plan.steps[step].pass,
            .resource = use.resource,
            .texel = fmt::format("{}, {}", x, y),
            .value = runtime::readTexel(texture, use.mip, use.layer, x, y,
                                        graph::infoOf(plan.graph->resources[use.resource].format).channels)
                         .text()};
    const auto before = std::ranges::find(rows_.rbegin(), rows_.rend(), use.resource, &Row::resource);
    row.same = before != rows_.rend() && before->texel == row.texel && before->value == row.value;
    rows_.push_back(std::move(row));
  });
}

std::uint32_t PixelPanel::draw(const graph::Plan& plan) {
  std::uint32_t clicked = graph::kNone;
  if (!place_) ImGui::TextDisabled("press X over the picture");
  if (!place_ || !beginTable("pixel", {"pass", "writes", "texel      ", "value"}, 3,
                             ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY))
    return clicked;
  int id = 0;
  for (const Row& row : rows_) {
    if (row.pass >= plan.graph->passNames.size() || row.resource >= plan.graph->resourceNames.size())
      continue;
    if (row.same) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::PushID(id++);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (ImGui::Selectable(plan.graph->passNames[row.pass].c_str(), false,
                          ImGuiSelectableFlags_SpanAllColumns))
      clicked = row.pass;
    cell(plan.graph->resourceNames[row.resource]);
    cell(row.texel);
    cell(row.value);
    ImGui::PopID();
    if (row.same) ImGui::PopStyleColor();
  }
  ImGui::EndTable();
  return clicked;
}

}  // namespace weft::app::ui
