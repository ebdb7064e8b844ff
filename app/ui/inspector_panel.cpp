// Declared in panels.h.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/ui/panels.h"

namespace weft::app::ui {

using graph::FlatResource;
using graph::ResourceKind;

namespace {

std::string describe(const FlatResource& resource) {
  return graph::shapeText(resource) +
         (resource.history > 0 ? fmt::format(", history {}", resource.history) : "");
}

bool canShow(const graph::Plan& plan, std::uint32_t resource) {
  return plan.firstStep[resource] != graph::kNone &&
         plan.graph->resources[resource].kind != ResourceKind::imported_buffer;
}

std::uint32_t indexIn(const std::vector<std::string>& names, const std::string& name) {
  const auto at = std::ranges::find(names, name);
  return at == names.end() ? graph::kNone : static_cast<std::uint32_t>(at - names.begin());
}

void slide(const char* label, std::uint32_t& value, std::uint32_t count) {
  if (count < 2) return;
  int x = static_cast<int>(std::min(value, count - 1));
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 8);
  if (ImGui::SliderInt(label, &x, 0, static_cast<int>(count) - 1, "%d", ImGuiSliderFlags_AlwaysClamp))
    value = static_cast<std::uint32_t>(x);
}

// After a pass: what it writes first, or the first that it writes of `resource`.
std::optional<runtime::InspectTarget> targetAfter(const graph::Plan& plan, std::uint32_t pass,
                                                  std::uint32_t resource = graph::kNone) {
  const graph::FlatGraph& graph = *plan.graph;
  for (const std::uint32_t u : graph.usesOf(pass)) {
    const graph::FlatUse& use = graph.uses[u];
    if (use.access == graph::Access::read || !canShow(plan, use.resource) ||
        (resource != graph::kNone && use.resource != resource))
      continue;
    return runtime::InspectTarget{.resource = graph.resourceNames[use.resource],
                                  .pass = graph.passNames[pass],
                                  .mip = use.mip,
                                  .layer = use.layer};
  }
  return std::nullopt;
}

// The next item on this line when it fits, else on the next.
void flow(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

}  // namespace

void InspectorPanel::beforeFrame(bool wanted, runtime::StepWatch::Look also) {
  runtime::Execution* execution = renderer_.execution();
  if (!execution) return;
  if (!wanted) {
    if (execution->watched()) release();
    if (also) execution->watch({.after = std::move(also)});
    return;
  }
  const graph::Plan& plan = execution->plan();
  const std::uint32_t resource = indexIn(plan.graph->resourceNames, target_.resource);
  if (resource == graph::kNone || !canShow(plan, resource)) {
    // What is presented, to begin with.
    target_ = {};
    if (plan.graph->present.resource != graph::kNone)
      target_.resource = plan.graph->resourceNames[plan.graph->present.resource];
  }
  found_ = inspector_.watch(*execution, target_, also);
  if (!found_ && !target_.pass.empty()) {
    target_.pass.clear();
    found_ = inspector_.watch(*execution, target_, also);
  }
  if (watched_ == target_) return;
  watched_ = target_;
  copiesBefore_ = inspector_.copies();
  statistics_.reset();
}

void InspectorPanel::select(const graph::Plan& plan, std::uint32_t pass) {
  target_ = targetAfter(plan, pass).value_or(target_);
}

void InspectorPanel::draw(bool inPlace, text::Diagnostics& diagnostics) {
  const graph::Plan& plan = renderer_.execution()->plan();
  if (!inPlace) chooseTarget(plan);
  const std::uint32_t index = indexIn(plan.graph->resourceNames, target_.resource);
  if (index == graph::kNone || !found_) {
    wantsFrame_ = target_.resource.empty() || !(target_ == watched_);  // not looked for yet
    ImGui::TextDisabled("nothing to look at");
    return;
  }
  const FlatResource& resource = plan.graph->resources[index];
  if (!inPlace) choosePart(resource);
  const bool arrived = target_ == watched_ && inspector_.copies() > copiesBefore_;
  wantsFrame_ = !arrived;
  if (resource.kind == ResourceKind::buffer) return drawNumbers();
  Look& look = looks_.of(plan, index, inspector_, arrived);
  if (!inPlace) chooseView(resource, look);
  Look whole = look;
  whole.moved = false;
  if (inPlace || !large) drawPicture(inPlace ? whole : look, diagnostics);
}

void InspectorPanel::chooseTarget(const graph::Plan& plan) {
  const graph::FlatGraph& graph = *plan.graph;
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 13);
  if (ImGui::BeginCombo("##resource", target_.resource.c_str(), ImGuiComboFlags_HeightLarge)) {
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    filter_.Draw("search", -4 * ImGui::GetFontSize());
    for (std::uint32_t r = 0; r < graph.resources.size(); ++r) {
      if (!canShow(plan, r) || !filter_.PassFilter(graph.resourceNames[r].c_str())) continue;
      const bool current = graph.resourceNames[r] == target_.resource;
      if (ImGui::Selectable(
              fmt::format("{}  ({})", graph.resourceNames[r], describe(graph.resources[r])).c_str(),
              current) &&
          !current)
        target_ = {.resource = graph.resourceNames[r]};
      if (current && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
    }
    ImGui::EndCombo();
  }
  const std::uint32_t index = indexIn(plan.graph->resourceNames, target_.resource);
  if (index == graph::kNone) return;
  const std::vector<std::string> writers = runtime::Inspector::writersOf(plan, index);
  if (writers.empty()) return;
  flow(ImGui::GetFontSize() * 14);
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 14);
  const std::string shown = "after " + (target_.pass.empty() ? writers.back() : target_.pass);
  if (ImGui::BeginCombo("##pass", shown.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const std::string& writer : writers)
      if (ImGui::Selectable(writer.c_str(), writer == target_.pass))
        target_ = targetAfter(plan, indexIn(graph.passNames, writer), index).value_or(target_);
    ImGui::EndCombo();
  }
}

void InspectorPanel::choosePart(const FlatResource& resource) {
  ImGui::TextDisabled("%s", describe(resource).c_str());
  const bool volume = resource.target == graph::Target::texture_3d;
  const std::uint32_t slices =
      volume ? std::max(1u, resource.depth >> std::min(target_.mip, resource.mips - 1u)) : resource.layers;
  slide("mip", target_.mip, resource.mips);
  if (resource.mips > 1 && slices > 1) flow(ImGui::GetFontSize() * 12);
  const bool cube =
      resource.target == graph::Target::texture_cube || resource.target == graph::Target::texture_cube_array;
  slide(volume ? "slice" : cube ? "face" : "layer", target_.layer, slices);
  slide("publications before", target_.history, resource.history + 1u);
  if (graph::hasStencil(resource.format)) ImGui::Checkbox("stencil", &target_.stencil);
}

void InspectorPanel::chooseView(const FlatResource& resource, Look& look) {
  runtime::InspectView& view = look.view;
  const float em = ImGui::GetFontSize();
  const bool depth = graph::isDepth(resource.format);
  const int channels = depth ? 1 : graph::infoOf(resource.format).channels;
  if (channels > 1) {
    static constexpr const char* kChannels[] = {"RGB", "R", "G", "B", "A"};
    int channel = std::min(static_cast<int>(view.channel), channels);
    ImGui::SetNextItemWidth(em * 4);
    if (ImGui::Combo("##channel", &channel, kChannels, channels + 1))
      view.channel = static_cast<runtime::InspectChannel>(channel);
    ImGui::SameLine();
  }
  float range[2] = {view.low, view.high};
  ImGui::SetNextItemWidth(em * 10);
  if (ImGui::DragFloat2("range", range, 0.01f, 0, 0, "%.4g")) {
    view.low = range[0];
    view.high = range[1];
  }
  flow(em * 4);
  if (ImGui::Button("fit range") && (statistics_ = inspector_.measure())) {
    view.low =
        static_cast<float>(*std::min_element(statistics_->low.begin(), statistics_->low.begin() + channels));
    view.high = static_cast<float>(
        *std::max_element(statistics_->high.begin(), statistics_->high.begin() + channels));
    view.ev = 0;
    view.depth = false;
  }
  tooltip("to what is there (waits for the GPU)");
  flow(em * 4);
  if (ImGui::Button("0..1")) {
    view.low = 0;
    view.high = 1;
    view.ev = 0;
  }
  flow(em * 10);
  ImGui::SetNextItemWidth(em * 6);
  ImGui::SliderFloat("EV", &view.ev, -10, 10, "%.1f");
  static constexpr const char* kColors[] = {"values", "false color", "direction", "motion"};
  int colors = static_cast<int>(view.colors);
  ImGui::SetNextItemWidth(em * 8);
  if (ImGui::Combo("##colors", &colors, kColors, 4))
    view.colors = static_cast<runtime::InspectColors>(colors);
  tooltip("a direction as red, green and blue; a motion as hue and brightness");
  flow(em * 5);
  ImGui::Checkbox("sRGB", &view.encode);
  flow(em * 12);
  ImGui::Checkbox("show NaN and clipping", &view.highlight);
  tooltip("NaN magenta, infinite cyan; striped: yellow above the range, blue below");
  if (depth) {
    flow(em * 7);
    if (ImGui::Checkbox("distance", &view.depth) && view.depth) view.high = std::max(view.high, 50.0f);
    tooltip("reversed depth d as near / d, in world units");
  }
  flow(em * 6);
  if (ImGui::Button("100 %")) {
    look.moved = true;
    view.texelsPerPixel = 1;
    view.x = view.y = 0;
  }
  flow(em * 5);
  if (ImGui::Button("whole")) look.moved = false;
  flow(em * 4);
  ImGui::Checkbox("flip", &look.flip);
  tooltip("the first row on top");
  flow(em * 5);
  ImGui::Checkbox("large", &large);
  tooltip("in the place of the picture");
  if (!statistics_) return;
  std::string means;
  for (int c = 0; c < channels; ++c)
    means += fmt::format("{}{:.4g}", c ? ", " : "", statistics_->mean[static_cast<std::size_t>(c)]);
  ImGui::TextDisabled(
      "%s",
      fmt::format("mean {}; {} NaN, {} infinite", means, statistics_->nan, statistics_->infinite).c_str());
}

void InspectorPanel::drawPicture(Look& look, text::Diagnostics& diagnostics) {
  runtime::InspectView& view = look.view;
  const gl::TextureRef picture = inspector_.picture();
  const float line = ImGui::GetTextLineHeightWithSpacing();
  ImVec2 area = ImGui::GetContentRegionAvail();
  area.x = std::floor(area.x);
  area.y = std::floor(area.y - line);
  if (picture.id == 0 || area.x < 16 || area.y < 16) {
    ImGui::TextDisabled(picture.id == 0 ? "the pass has not run yet" : "make the window larger");
    return;
  }
  const double width = picture.desc.width, height = picture.desc.height;
  if (!look.moved) {
    view.texelsPerPixel = std::max(width / area.x, height / area.y);
    view.x = (width - area.x * view.texelsPerPixel) / 2;
    view.y = (height - area.y * view.texelsPerPixel) / 2;
  }
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("canvas", area,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  const ImGuiIO& io = ImGui::GetIO();
  // From the lower left.
  const double px = io.MousePos.x - corner.x,
               py = look.flip ? io.MousePos.y - corner.y : corner.y + area.y - io.MousePos.y;
  if (ImGui::IsItemActive()) {
    look.moved |= io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
    view.x -= io.MouseDelta.x * view.texelsPerPixel;
    view.y += (look.flip ? -io.MouseDelta.y : io.MouseDelta.y) * view.texelsPerPixel;
  }
  const bool hovered = ImGui::IsItemHovered() || (large && !io.WantCaptureMouse);
  if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
    look.moved = true;
    const double before = view.texelsPerPixel;
    view.texelsPerPixel = std::clamp(before * std::pow(0.8, io.MouseWheel), 1.0 / 64, 64.0);
    view.x += px * (before - view.texelsPerPixel);
    view.y += py * (before - view.texelsPerPixel);
  }
  const float bottom = look.flip ? 1 : 0;
  const GLuint canvas = inspector_.draw(view, static_cast<std::uint32_t>(area.x),
                                        static_cast<std::uint32_t>(area.y), diagnostics);
  const ImVec2 end(corner.x + area.x, corner.y + area.y);
  if (canvas)
    ImGui::GetWindowDrawList()->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(canvas)),
                                         corner, end, {0, 1 - bottom}, {1, bottom});
  const double tx = std::floor(view.x + px * view.texelsPerPixel),
               ty = std::floor(view.y + py * view.texelsPerPixel);
  std::string text = fmt::format("{:.0f} %; point at a texel for its value", 100 / view.texelsPerPixel);
  if (hovered && tx >= 0 && ty >= 0 && tx < width && ty < height)
    if (const auto texel = inspector_.texel(static_cast<std::uint32_t>(tx), static_cast<std::uint32_t>(ty)))
      text = fmt::format("[{:.0f}, {:.0f}] = {}{}", tx, ty, texel->text(),
                         view.depth && texel->value[0] > 0
                             ? fmt::format(", distance {:.4g}", view.nearPlane / texel->value[0])
                             : "");
  ImGui::TextUnformatted(text.c_str());
}

void InspectorPanel::drawNumbers() {
  static constexpr const char* kForms[] = {"float", "hexadecimal", "unsigned", "signed"};
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
  ImGui::Combo("as", &numbers_, kForms, 4);
  const std::uint64_t bytes = inspector_.bufferBytes();
  if (!ImGui::BeginTable("numbers", 5,
                         ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchSame))
    return;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>((bytes + 15) / 16));
  while (clipper.Step()) {
    const std::uint64_t first = static_cast<std::uint64_t>(clipper.DisplayStart) * 16;
    const std::vector<std::byte> data =
        inspector_.bytes(first, static_cast<std::uint64_t>(clipper.DisplayEnd) * 16 - first);
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%6d", row * 16);
      for (std::size_t word = 0; word < 4; ++word) {
        const std::size_t at = static_cast<std::size_t>(row - clipper.DisplayStart) * 16 + word * 4;
        ImGui::TableNextColumn();
        if (at + 4 > data.size()) continue;
        std::uint32_t bits = 0;
        float number = 0;
        std::memcpy(&bits, data.data() + at, 4);
        std::memcpy(&number, data.data() + at, 4);
        const std::string text = numbers_ == 0   ? fmt::format("{}", number)
                                 : numbers_ == 1 ? fmt::format("{:08x}", bits)
                                 : numbers_ == 2 ? fmt::format("{}", bits)
                                                 : fmt::format("{}", static_cast<std::int32_t>(bits));
        ImGui::TextUnformatted(text.c_str());
      }
    }
  }
  ImGui::EndTable();
}

}  // namespace weft::app::ui
