#include "app/view/screens.h"

#include <imgui.h>

#include <algorithm>
#include <vector>

#include "app/view/key_bindings.h"

namespace weft::app {

namespace {

constexpr ImGuiWindowFlags kNotice = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                     ImGuiWindowFlags_NoFocusOnAppearing;
constexpr float kMargin = 8;  // pixels around a notice, at scale 1

}  // namespace

void drawHelp() {
  const ImGuiStyle& style = ImGui::GetStyle();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  std::vector<const KeyBinding*> rows;
  float keysWidth = 0, textWidth = 0;
  for (const KeyBinding& binding : keyBindings()) {
    if (!*binding.keys) continue;
    rows.push_back(&binding);
    keysWidth = std::max(keysWidth, ImGui::CalcTextSize(binding.keys).x);
    textWidth = std::max(textWidth, ImGui::CalcTextSize(binding.does).x);
  }
  const float gap = ImGui::GetFontSize(), rowHeight = ImGui::GetTextLineHeightWithSpacing();
  const ImVec2 room(std::max(1.0f, screen.x - 2 * (kMargin + style.WindowPadding.x)),
                    std::max(1.0f, screen.y - 2 * (kMargin + style.WindowPadding.y)));
  const float rowWidth = keysWidth + gap + textWidth + gap;
  const auto count = static_cast<int>(rows.size());
  constexpr int kColumns = 2;
  const int high = (count + kColumns - 1) / kColumns;
  const float scale =
      std::min({1.0f, room.x / (rowWidth * kColumns), room.y / (rowHeight * static_cast<float>(high))});
  const ImVec2 size(kColumns * rowWidth * scale + 2 * style.WindowPadding.x,
                    static_cast<float>(high) * rowHeight * scale + 2 * style.WindowPadding.y);
  ImGui::SetNextWindowPos({(screen.x - size.x) / 2, (screen.y - size.y) / 2}, ImGuiCond_Always);
  ImGui::SetNextWindowSize(size, ImGuiCond_Always);
  ImGui::SetNextWindowFocus();
  ImGui::SetNextWindowBgAlpha(1);
  ImGui::Begin("Help", nullptr, kNotice | ImGuiWindowFlags_NoInputs);
  ImGui::SetWindowFontScale(scale);
  for (int i = 0; i < count; ++i) {
    const float x = style.WindowPadding.x + static_cast<float>(i / high) * rowWidth * scale;
    const float y = style.WindowPadding.y + static_cast<float>(i % high) * rowHeight * scale;
    ImGui::SetCursorPos({x, y});
    ImGui::TextColored({0.6f, 0.85f, 1, 1}, "%s", rows[static_cast<std::size_t>(i)]->keys);
    ImGui::SetCursorPos({x + (keysWidth + gap) * scale, y});
    ImGui::TextUnformatted(rows[static_cast<std::size_t>(i)]->does);
  }
  ImGui::End();
}

void drawModes(const std::string& modes) {
  if (modes.empty()) return;
  ImGui::SetNextWindowPos({kMargin, kMargin}, ImGuiCond_Always);
  ImGui::SetNextWindowBgAlpha(0.6f);
  ImGui::Begin("Modes", nullptr, kNotice | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextUnformatted(modes.c_str());
  ImGui::End();
}

void drawWaiting(std::span<const text::Diagnostic> problems) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({kMargin, kMargin}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({screen.x - 2 * kMargin, screen.y - 2 * kMargin}, ImGuiCond_Always);
  ImGui::Begin("Waiting", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
  ImGui::PushTextWrapPos(0);
  ImGui::TextColored(
      {1, 0.7f, 0.3f, 1},
      "Nothing to show yet: the files have errors. The picture comes as soon as they are saved without.");
  ImGui::Spacing();
  for (const text::Diagnostic& each : problems) ImGui::TextUnformatted(text::format(each).c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

}  // namespace weft::app
