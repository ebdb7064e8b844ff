// The texture inspector's window: which resource, where in the frame, which part, how shown; zoom, pan and the value under
// the cursor.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/inspection/inspector.h"

namespace weft::app::ui {

// "rgba16f 1280x720, 8 mips" of a resource or a storage.
template <class Texture>
std::string shapeText(const Texture& texture) {
  std::string text =
      fmt::format("{} {}x{}", graph::infoOf(texture.format).name, texture.width, texture.height);
  if (texture.depth > 1) text += fmt::format("x{}", texture.depth);
  if (texture.mips > 1) text += fmt::format(", {} mips", texture.mips);
  if (texture.layers > 1) text += fmt::format(", {} layers", texture.layers);
  return text;
}

class InspectorPanel {
 public:
  explicit InspectorPanel(runtime::Renderer& renderer) : renderer_(renderer), inspector_(renderer.device()) {}

  // To be called before each frame. `wanted`: the window is open.
  void beforeFrame(bool wanted);
  // Draws the contents of the window.
  void draw(text::Diagnostics& diagnostics);
  void release();
  bool wantsFrame() const { return wantsFrame_; }  // something else is to be copied

 private:
  void chooseTarget(const graph::Plan& plan);
  void choosePart(const graph::FlatResource& resource);
  void chooseView(const graph::FlatResource& resource);
  void drawPicture(text::Diagnostics& diagnostics);
  void drawNumbers();

  runtime::Renderer& renderer_;
  runtime::Inspector inspector_;
  runtime::InspectTarget target_;
  runtime::InspectView view_;
  std::string shown_;   // resource of the last frame
  std::string fitted_;  // resource and part that the zoom was fitted to
  bool found_ = false, fit_ = true, wantsFrame_ = false;
  std::optional<runtime::InspectStatistics> statistics_;
  int numbers_ = 0;  // buffers: 0 float, 1 hexadecimal, 2 unsigned, 3 signed
};

}  // namespace weft::app::ui
