#include "app/ui/pass_pictures.h"

#include <algorithm>
#include <cmath>

#include "app/ui/panels.h"

namespace weft::app::ui {

namespace {

constexpr std::size_t kPerFrame = 2;
constexpr float kNarrowest = 0.6f, kWidest = 2.4f;  // of a picture, relative to its height

}  // namespace

void PassPictures::list(const std::vector<PassRow>& rows, const graph::Plan& plan) {
  const graph::FlatGraph& graph = *plan.graph;
  std::vector<Tile> tiles;
  for (const PassRow& row : rows) {
    Tile tile{.step = graph::kNone};
    std::uint32_t most = 0;  // texels of what it shows
    for (const std::uint32_t pass : row.effect() ? std::vector<std::uint32_t>() : row.passes) {
      if (plan.stepOf[pass] == graph::kNone) continue;
      if (tile.step == graph::kNone)
        tile = {.pass = pass, .step = plan.stepOf[pass], .target{.pass = graph.passNames[pass]}};
      for (const std::uint32_t u : graph.usesOf(pass)) {
        const graph::FlatUse& use = graph.uses[u];
        const graph::FlatResource& to = graph.resources[use.resource];
        if (use.access == graph::Access::read || to.kind != graph::ResourceKind::texture ||
            plan.firstStep[use.resource] == graph::kNone)
          continue;
        const std::uint32_t texels =
            std::max(1u, to.width >> use.mip) * std::max<std::uint32_t>(1u, to.height >> use.mip);
        if (std::exchange(most, std::max(most, texels)) >= texels) break;
        tile.pass = pass;
        tile.step = plan.stepOf[pass];
        tile.resource = use.resource;
        tile.target = {.resource = graph.resourceNames[use.resource],
                       .pass = graph.passNames[pass],
                       .mip = use.mip,
                       .layer = use.layer};
        break;
      }
    }
    if (tile.step == graph::kNone) continue;
    tile.label = row.label;
    // The picture of the plan before stays until there is another.
    const auto before = std::ranges::find(
        tiles_, tile.target, [](const Tile& each) -> const auto& { return each.target; });
    if (before != tiles_.end()) tile.texture = std::move(before->texture);
    tiles.push_back(std::move(tile));
  }
  std::ranges::stable_sort(tiles, {}, &Tile::step);
  tiles_ = std::move(tiles);
  next_ = 0;
}

void PassPictures::beforeFrame(bool changed) {
  for (Tile& tile : tiles_) {
    tile.stale |= changed;
    tile.wanted = false;
  }
  std::size_t taken = 0;
  for (std::size_t i = 0; i < tiles_.size() && taken < kPerFrame; ++i) {
    Tile& tile = tiles_[next_++ % tiles_.size()];
    tile.wanted = tile.inView && tile.resource != graph::kNone;
    taken += tile.wanted;
    if (tile.inView) tile.stale = false;
  }
}

void PassPictures::afterStep(runtime::Execution& execution, std::uint32_t step) {
  for (Tile& tile : tiles_) {
    if (!tile.wanted || tile.step != step || !execution.steps().hasResults(step) ||
        !inspector_.look(execution, tile.target))
      continue;
    const Look& look = looks_.of(execution.plan(), tile.resource, inspector_, true);
    runtime::InspectView view = look.view;
    tile.flip = look.flip;
    const gl::TextureDesc& from = inspector_.picture().desc;
    const auto high = static_cast<std::uint32_t>(std::max(height_, 16.0f));
    const auto wide = static_cast<std::uint32_t>(
        static_cast<float>(high) *
        std::clamp(static_cast<float>(from.width) / static_cast<float>(from.height), kNarrowest, kWidest));
    const double width = from.width, height = from.height;
    view.texelsPerPixel = std::max(width / wide, height / high);
    view.x = (width - wide * view.texelsPerPixel) / 2;
    view.y = (height - high * view.texelsPerPixel) / 2;
    const gl::TextureDesc wanted{.format = GL_RGBA8, .width = wide, .height = high};
    if (!tile.texture || !(tile.texture.desc() == wanted))
      if (auto made = gl::Texture::create(wanted, "picture of a pass", said_))
        tile.texture = std::move(*made);
    const GLuint canvas = tile.texture ? inspector_.draw(view, wide, high, said_) : 0;
    if (canvas)
      glCopyImageSubData(canvas, GL_TEXTURE_2D, 0, 0, 0, 0, tile.texture.id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                         static_cast<GLsizei>(wide), static_cast<GLsizei>(high), 1);
  }
}

std::uint32_t PassPictures::draw(const graph::Plan& plan, std::uint32_t selected,
                                 text::Diagnostics& diagnostics) {
  diagnostics.append(std::exchange(said_, {}));
  std::uint32_t clicked = graph::kNone;
  ImGui::BeginChild("strip", {}, false, ImGuiWindowFlags_HorizontalScrollbar);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  height_ = std::floor(std::min(
      room.y - ImGui::GetTextLineHeightWithSpacing() - ImGui::GetStyle().ScrollbarSize, room.x / kWidest));
  if (ImGui::IsWindowHovered())
    ImGui::SetScrollX(ImGui::GetScrollX() - ImGui::GetIO().MouseWheel * 8 * ImGui::GetFontSize());
  for (Tile& tile : tiles_) {
    ImGui::PushID(static_cast<int>(tile.pass));
    ImGui::BeginGroup();
    drawTile(tile, plan);
    ImGui::EndGroup();
    if (ImGui::IsItemClicked()) clicked = shown_ = tile.pass;
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    if (tile.pass == selected) {
      ImGui::GetWindowDrawList()->AddRect({low.x - 2, low.y}, {high.x + 2, high.y},
                                          ImGui::GetColorU32(ImGuiCol_CheckMark));
      if (std::exchange(shown_, selected) != selected) ImGui::SetScrollHereX();
    }
    ImGui::SameLine();
    ImGui::PopID();
  }
  ImGui::EndChild();
  return clicked;
}

void PassPictures::drawTile(Tile& tile, const graph::Plan& plan) {
  const gl::TextureDesc& desc = tile.texture.desc();
  const float high = std::max(height_, 16.0f);
  const float wide = tile.texture ? high * static_cast<float>(desc.width) / static_cast<float>(desc.height)
                                  : high * kNarrowest;
  const ImVec2 corner = ImGui::GetCursorScreenPos(), end(corner.x + wide, corner.y + high);
  ImGui::InvisibleButton("picture", {wide, high});
  tile.inView = ImGui::IsItemVisible();
  std::string tip = plan.graph->passNames[tile.pass] + "\nwrites no texture";
  if (tile.resource != graph::kNone)
    tip = fmt::format("{}\n{}: {}", tile.target.pass, tile.target.resource,
                      graph::shapeText(plan.graph->resources[tile.resource]));
  tooltip(tip);
  const float bottom = tile.flip ? 1 : 0;
  if (tile.texture)
    ImGui::GetWindowDrawList()->AddImage(
        reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(tile.texture.id())), corner, end,
        {0, 1 - bottom}, {1, bottom});
  else
    ImGui::GetWindowDrawList()->AddRect(corner, end, ImGui::GetColorU32(ImGuiCol_Border));
  const ImVec2 under = ImGui::GetCursorScreenPos();
  const ImVec4 room(under.x, under.y, under.x + wide, under.y + ImGui::GetTextLineHeight());
  ImGui::GetWindowDrawList()->AddText(nullptr, 0, under, ImGui::GetColorU32(ImGuiCol_Text),
                                      tile.label.c_str(), nullptr, 0, &room);
  ImGui::Dummy({wide, ImGui::GetTextLineHeight()});
}

}  // namespace weft::app::ui
