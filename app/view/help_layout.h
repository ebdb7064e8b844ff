// How a list of rows fits a window: in how many columns, and how much smaller than it would like to be. Does
// not: draw.
#pragma once

#include <algorithm>

namespace weft::app {

struct HelpLayout {
  int columns = 1;
  float scale = 1;  // of the text, at most 1
};

// The largest text for which `rows` rows, each `rowHeight` by `rowWidth` at scale 1, fit `width` by `height`.
inline HelpLayout fitHelp(int rows, float rowHeight, float rowWidth, float width, float height) {
  HelpLayout best{1, 0};
  for (int columns = 1; columns <= 4; ++columns) {
    const int high = (rows + columns - 1) / columns;
    const float scale = std::min({1.0f, width / (rowWidth * static_cast<float>(columns)),
                                  height / (rowHeight * static_cast<float>(high))});
    if (scale > best.scale) best = {columns, scale};
  }
  return best;
}

}  // namespace weft::app
