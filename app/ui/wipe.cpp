#include "app/ui/wipe.h"

#include <algorithm>

namespace weft::app::ui {

bool Wipe::toggle(const gl::TextureRef& presented, text::Diagnostics& diagnostics) {
  if (on()) return kept_.reset(), true;
  gl::TextureDesc wanted{
      .format = presented.desc.format, .width = presented.desc.width, .height = presented.desc.height};
  if (wanted.format == GL_SRGB8_ALPHA8) wanted.format = GL_RGBA8;  // its bits are what a screen shows
  auto made = gl::Texture::create(wanted, "kept picture", diagnostics);
  if (!made) return false;
  kept_ = std::move(*made);
  glCopyImageSubData(presented.id, GL_TEXTURE_2D, 0, 0, 0, 0, kept_.id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                     static_cast<GLsizei>(wanted.width), static_cast<GLsizei>(wanted.height), 1);
  glTextureParameteri(kept_.id(), GL_TEXTURE_SWIZZLE_A, GL_ONE);
  return true;
}

void Wipe::draw(const Panels::Area& area) {
  if (!on()) return;
  const float left = static_cast<float>(area.x), width = static_cast<float>(area.width);
  const float bottom = ImGui::GetIO().DisplaySize.y - static_cast<float>(area.y),
              top = bottom - static_cast<float>(area.height);
  const float line = left + std::round(width * at_), half = ImGui::GetFontSize() / 2;
  const auto texture = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(kept_.id()));
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddImage(texture, {left, top}, {line, bottom}, {0, 1}, {(line - left) / width, 0});
  list.AddLine({line, top}, {line, bottom}, ImGui::GetColorU32(ImGuiCol_Text), 2);
  ImGui::SetNextWindowPos({line - half, top});
  ImGui::SetNextWindowSize({2 * half, bottom - top});
  ImGui::Begin("wipe", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::SetCursorPos({0, 0});
  ImGui::InvisibleButton("line", {2 * half, bottom - top});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActive()) at_ = std::clamp((ImGui::GetIO().MousePos.x - left) / width, 0.0f, 1.0f);
  ImGui::End();
}

}  // namespace weft::app::ui
