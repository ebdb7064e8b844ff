// A strip of small pictures: of each stanza that runs, what it writes first, of the repeats the largest. A few that are in view are drawn
// anew in each frame, in turn.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/ui/looks.h"
#include "app/ui/pass_rows.h"

namespace weft::app::ui {

class PassPictures {
 public:
  PassPictures(runtime::Device& device, Looks& looks) : inspector_(device), looks_(looks) {}

  // The stanzas of a new plan.
  void list(const std::vector<PassRow>& rows, const graph::Plan& plan);
  // Before each frame of that plan: takes those whose turn it is. `changed`: all are out of date.
  void beforeFrame(bool changed);
  // After each of its steps.
  void afterStep(runtime::Execution& execution, std::uint32_t step);
  // In idle mode: some in view are not drawn yet.
  bool wantsFrame() const {
    return std::ranges::any_of(tiles_, [](const Tile& tile) { return tile.inView && tile.stale; });
  }
  // The pass that was clicked, or kNone.
  std::uint32_t draw(const graph::Plan& plan, std::uint32_t selected, text::Diagnostics& diagnostics);

 private:
  struct Tile {
    std::uint32_t pass = 0, step = 0;
    std::uint32_t resource = graph::kNone;  // kNone: the pass writes no texture
    runtime::InspectTarget target;
    std::string label;
    gl::Texture texture;
    bool stale = true;  // since what is in it may have changed
    bool inView = false, wanted = false, flip = false;
  };
  void drawTile(Tile& tile, const graph::Plan& plan);

  runtime::Inspector inspector_;
  Looks& looks_;
  std::vector<Tile> tiles_;
  std::size_t next_ = 0;
  std::uint32_t shown_ = graph::kNone;  // the selected pass, to which the strip was scrolled
  float height_ = 0;                    // of the pictures
  text::Diagnostics said_;
};

}  // namespace weft::app::ui
