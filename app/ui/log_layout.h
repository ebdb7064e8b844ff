// How high the log stands at the bottom of the window while nothing in it asks for more. Does not: draw it
// (app/ui/log_panel.cpp).
#pragma once

#include <imgui.h>

#include <algorithm>

namespace weft::app::ui {

inline float logHeight() {
  const float screen = ImGui::GetIO().DisplaySize.y;
  return std::max(64.0f, std::min(screen * 0.2f, ImGui::GetFontSize() * 9));
}

}  // namespace weft::app::ui
