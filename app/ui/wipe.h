// Two pictures beside each other: the one that was kept, and the present one, with a line between them that can be dragged.
#pragma once

#include "app/ui/panels.h"
#include "engine/gl/objects/objects.h"

namespace weft::app::ui {

class Wipe {
 public:
  bool on() const { return static_cast<bool>(kept_); }
  // Keeps a copy of what is presented, or lets it go. False after errors.
  bool toggle(const gl::TextureRef& presented, text::Diagnostics& diagnostics);
  // While panels are made: the kept picture, left of the line, over the present one in `area`.
  void draw(const Panels::Area& area);

 private:
  gl::Texture kept_;
  float at_ = 0.5f;  // of the width
};

}  // namespace weft::app::ui
