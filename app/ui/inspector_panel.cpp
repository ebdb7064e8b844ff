// Declared in panels.h.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "app/ui/panels.h"

namespace weft::app::ui {

using graph::FlatResource;
using graph::ResourceKind;

namespace {

std::string describe(const FlatResource& resource) {
  if (resource.kind == ResourceKind::buffer) return fmt::format("buffer, {} bytes", resource.bytes);
  return shapeText(resource) + (resource.history > 0 ? fmt::format(", history {}", resource.history) : "");
}

bool canShow(const graph::Plan& plan, std::uint32_t resource) {
  return plan.firstStep[resource] != graph::kNone &&
         plan.graph->resources[resource].kind != ResourceKind::imported_buffer;
}

std::uint32_t indexOf(const graph::Plan& plan, const std::string& name) {
  const auto& names = plan.graph->resourceNames;
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

// The next item on this line when it fits, else on the next.
void flow(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

}  // namespace

void InspectorPanel::beforeFrame(bool wanted) {
  runtime::Execution* execution = renderer_.execution();
  if (!execution) return;
  if (!wanted) {
    if (execution->watched()) release();
    return;
  }
  const graph::Plan& plan = execution->plan();
  const std::uint32_t resource = indexOf(plan, target_.resource);
  if (resource == graph::kNone || !canShow(plan, resource)) {
    // What is presented, to begin with.
    target_ = {};
    if (plan.graph->present.resource != graph::kNone)
      target_.resource = plan.graph->resourceNames[plan.graph->present.resource];
  }
  if (target_.resource != shown_) {
    const std::uint32_t shown = indexOf(plan, target_.resource);
    if (shown != graph::kNone) view_.encode = runtime::Inspector::viewOf(plan.graph->resources[shown]).encode;
    shown_ = target_.resource;
  }
  found_ = inspector_.watch(*execution, target_);
  if (!found_ && !target_.pass.empty()) {
    target_.pass.clear();
    found_ = inspector_.watch(*execution, target_);
  }
}

void InspectorPanel::release() {
  if (renderer_.execution()) inspector_.release(*renderer_.execution());
}

void InspectorPanel::draw(text::Diagnostics& diagnostics) {
  const graph::Plan& plan = renderer_.execution()->plan();
  const runtime::InspectTarget before = target_;
  const std::uint64_t copies = inspector_.copies();
  chooseTarget(plan);
  const std::uint32_t index = indexOf(plan, target_.resource);
  if (index == graph::kNone || !found_) {
    wantsFrame_ = target_.resource.empty();
    ImGui::TextDisabled("nothing to look at");
    return;
  }
  const FlatResource& resource = plan.graph->resources[index];
  choosePart(resource);
  if (resource.kind == ResourceKind::buffer) {
    drawNumbers();
  } else {
    chooseView(resource);
    drawPicture(diagnostics);
  }
  wantsFrame_ = !(target_ == before) || copies == 0;
}

void InspectorPanel::chooseTarget(const graph::Plan& plan) {
  const graph::FlatGraph& graph = *plan.graph;
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 13);
  if (ImGui::BeginCombo("##resource", target_.resource.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (std::uint32_t r = 0; r < graph.resources.size(); ++r) {
      if (!canShow(plan, r)) continue;
      const bool current = graph.resourceNames[r] == target_.resource;
      if (ImGui::Selectable(
              fmt::format("{}  ({})", graph.resourceNames[r], describe(graph.resources[r])).c_str(),
              current) &&
          !current) {
        target_ = {.resource = graph.resourceNames[r]};
        statistics_.reset();
      }
    }
    ImGui::EndCombo();
  }
  const std::uint32_t index = indexOf(plan, target_.resource);
  if (index == graph::kNone) return;
  const std::vector<std::string> writers = runtime::Inspector::writersOf(plan, index);
  if (writers.empty()) return;
  flow(ImGui::GetFontSize() * 14);
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 14);
  const std::string shown = "after " + (target_.pass.empty() ? writers.back() : target_.pass);
  if (ImGui::BeginCombo("##pass", shown.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (const std::string& writer : writers)
      if (ImGui::Selectable(writer.c_str(), writer == target_.pass)) target_.pass = writer;
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
  slide("frames ago", target_.history, resource.history + 1u);
  if (graph::hasStencil(resource.format)) ImGui::Checkbox("stencil", &target_.stencil);
}

void InspectorPanel::chooseView(const FlatResource& resource) {
  const float em = ImGui::GetFontSize();
  const bool depth = graph::isDepth(resource.format);
  const int channels = depth ? 1 : graph::infoOf(resource.format).channels;
  if (channels > 1) {
    static constexpr const char* kChannels[] = {"RGB", "R", "G", "B", "A"};
    int channel = std::min(static_cast<int>(view_.channel), channels);
    ImGui::SetNextItemWidth(em * 4);
    if (ImGui::Combo("##channel", &channel, kChannels, channels + 1))
      view_.channel = static_cast<runtime::InspectChannel>(channel);
    ImGui::SameLine();
  }
  float range[2] = {view_.low, view_.high};
  ImGui::SetNextItemWidth(em * 10);
  if (ImGui::DragFloat2("range", range, 0.01f, 0, 0, "%.4g")) {
    view_.low = range[0];
    view_.high = range[1];
  }
  flow(em * 4);
  if (ImGui::Button("Fit")) statistics_ = inspector_.measure();
  tooltip("the range of what is there (waits for the GPU)");
  if (ImGui::IsItemDeactivated() && statistics_) {
    view_.low =
        static_cast<float>(*std::min_element(statistics_->low.begin(), statistics_->low.begin() + channels));
    view_.high = static_cast<float>(
        *std::max_element(statistics_->high.begin(), statistics_->high.begin() + channels));
    view_.ev = 0;
    view_.depth = false;
  }
  flow(em * 7);
  if (ImGui::Button("0..1")) {
    view_.low = 0;
    view_.high = 1;
    view_.ev = 0;
  }
  flow(em * 10);
  ImGui::SetNextItemWidth(em * 6);
  ImGui::SliderFloat("EV", &view_.ev, -10, 10, "%.1f");
  ImGui::Checkbox("false color", &view_.falseColor);
  flow(em * 5);
  ImGui::Checkbox("sRGB", &view_.encode);
  flow(em * 5);
  ImGui::Checkbox("marks", &view_.highlight);
  tooltip("NaN magenta, infinite cyan; striped: yellow above the range, blue below");
  if (depth) {
    flow(em * 7);
    if (ImGui::Checkbox("distance", &view_.depth) && view_.depth) view_.high = std::max(view_.high, 50.0f);
    tooltip("reversed depth d as near / d, in world units");
  }
  flow(em * 6);
  if (ImGui::Button("1:1")) {
    view_.texelsPerPixel = 1;
    view_.x = view_.y = 0;
  }
  flow(em * 5);
  if (ImGui::Button("Whole")) fit_ = true;
  if (statistics_)
    ImGui::TextDisabled("%s", fmt::format("mean {:.4g}, {:.4g}, {:.4g}, {:.4g}; {} NaN, {} infinite",
                                          statistics_->mean[0], statistics_->mean[1], statistics_->mean[2],
                                          statistics_->mean[3], statistics_->nan, statistics_->infinite)
                                  .c_str());
}

void InspectorPanel::drawPicture(text::Diagnostics& diagnostics) {
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
  const std::string part = fmt::format("{} {}x{}", target_.resource, width, height);
  if (fit_ || part != fitted_) {
    view_.texelsPerPixel = std::max(width / area.x, height / area.y);
    view_.x = (width - area.x * view_.texelsPerPixel) / 2;
    view_.y = (height - area.y * view_.texelsPerPixel) / 2;
    fitted_ = part;
    fit_ = false;
  }
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("canvas", area,
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
  const ImGuiIO& io = ImGui::GetIO();
  const double px = io.MousePos.x - corner.x, py = corner.y + area.y - io.MousePos.y;  // from the lower left
  if (ImGui::IsItemActive()) {
    view_.x -= io.MouseDelta.x * view_.texelsPerPixel;
    view_.y += io.MouseDelta.y * view_.texelsPerPixel;
  }
  const bool hovered = ImGui::IsItemHovered();
  if (hovered && io.MouseWheel != 0) {
    const double before = view_.texelsPerPixel;
    view_.texelsPerPixel = std::clamp(before * std::pow(0.8, io.MouseWheel), 1.0 / 64, 64.0);
    view_.x += px * (before - view_.texelsPerPixel);
    view_.y += py * (before - view_.texelsPerPixel);
  }
  const GLuint canvas = inspector_.draw(view_, static_cast<std::uint32_t>(area.x),
                                        static_cast<std::uint32_t>(area.y), diagnostics);
  const ImVec2 end(corner.x + area.x, corner.y + area.y);
  if (canvas)
    ImGui::GetWindowDrawList()->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(canvas)),
                                         corner, end, {0, 1}, {1, 0});
  const double tx = std::floor(view_.x + px * view_.texelsPerPixel),
               ty = std::floor(view_.y + py * view_.texelsPerPixel);
  std::string text = fmt::format("{:.0f} %; values under the cursor", 100 / view_.texelsPerPixel);
  if (hovered && tx >= 0 && ty >= 0 && tx < width && ty < height)
    if (const auto texel = inspector_.texel(static_cast<std::uint32_t>(tx), static_cast<std::uint32_t>(ty)))
      text = fmt::format("[{:.0f}, {:.0f}] = {}", tx, ty, texel->text());
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
