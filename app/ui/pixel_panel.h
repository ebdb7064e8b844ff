// One pixel of the picture, through the frame: the value that each pass leaves there, in all textures that have the picture's shape.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/runtime/inspection/inspector.h"

namespace weft::app::ui {

class PixelPanel {
 public:
  // From the picture's lower left corner, 0 to 1 each way.
  void mark(glm::dvec2 place) { place_ = place; }
  // Before a frame, and after each of its steps.
  void beforeFrame() { rows_.clear(); }
  void afterStep(runtime::Execution& execution, std::uint32_t step);
  // The pass that was clicked, or kNone.
  std::uint32_t draw(const graph::Plan& plan);

 private:
  struct Row {
    std::uint32_t pass = 0, resource = 0;
    std::string texel, value;
    bool same = false;  // as the pass before left it
  };
  std::optional<glm::dvec2> place_;
  std::vector<Row> rows_;  // of the last frame
};

}  // namespace weft::app::ui
