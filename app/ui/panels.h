// The viewer's panels: parameters, passes, texture inspector, frame profiler, storage, histogram, log. Each is made anew
// every frame from what it shows and keeps what a person chose in it; changes go straight into the LiveGraph.
#pragma once

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/live/live_graph.h"
#include "app/ui/log.h"
#include "engine/graph/print/explain.h"
#include "engine/runtime/inspection/frame_profiler.h"
#include "engine/runtime/inspection/inspector.h"
#include "engine/runtime/inspection/picture_histogram.h"

namespace weft::app::ui {

// Of the last item, where the mouse is over it.
void tooltip(const std::string& text);
void tooltip(const std::string& text, bool hovered);
// A table with a row of titles, of which the one that stretches takes what the others leave. False where none of it is seen.
bool beginTable(const char* id, std::initializer_list<const char*> titles, int stretched,
                ImGuiTableFlags flags);
void cell(const std::string& text);  // the next one of a table

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

// The texture inspector's window: which resource, where in the frame, which part, how shown; zoom, pan and the value under the
// cursor.
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

class Panels {
 public:
  Panels(LiveGraph& live, runtime::Renderer& renderer, Log& log);
  ~Panels();
  Panels(const Panels&) = delete;
  Panels& operator=(const Panels&) = delete;

  bool visible = true;

  // Shows or hides one by its name, as kPanels has them. False for another name.
  bool toggle(std::string_view panel);
  static std::vector<std::string> names();

  // Around Renderer::frame().
  void beforeFrame();
  void afterFrame();
  // Between Overlay::begin() and end(). `diagnostics` gets what a change that was made here led to.
  void draw(const runtime::FrameReport& report, text::Diagnostics& diagnostics);

  void drawLog();  // alone, where there is nothing to draw panels of

  // In idle mode: what was chosen shows only in another frame of the graph.
  bool wantsFrame() const { return visible && open_[kInspector] && inspector_.wantsFrame(); }

  // Writes what was changed here into the files; says what it wrote in the log.
  void writeBack(text::Diagnostics& diagnostics);

 private:
  enum Panel : std::size_t { kParameters, kPasses, kInspector, kProfiler, kStorage, kHistogram, kPanelCount };

  void drawMenu(text::Diagnostics& diagnostics);
  void arrange();
  bool begin(Panel panel);
  void drawPasses(text::Diagnostics& diagnostics);
  void drawParameters(const runtime::FrameReport& report, text::Diagnostics& diagnostics);
  void drawProfiler();
  void drawStorage();
  void drawHistogram();
  void drawLoading();       // what is being loaded, whether or not the panels are visible
  float logHeight() const;  // while nothing in the log asks for more
  bool measureBox();        // whether each pass is measured

  LiveGraph& live_;
  runtime::Renderer& renderer_;
  Log& log_;
  runtime::FrameProfiler profiler_;
  InspectorPanel inspector_;
  runtime::PictureHistogram histogram_;
  std::unique_ptr<graph::Explainer> explainer_;  // of the plan of `explained_`
  std::uint64_t explained_ = 0;

  struct Place {
    float x = 0, y = 0, width = 0, height = 0;
  };
  std::array<bool, kPanelCount> open_{true, true};
  std::array<Place, kPanelCount> places_{};
  Panel latest_ = kPasses;        // shown or hidden last
  float width_ = 0, height_ = 0;  // of the window when it was arranged
  bool arrange_ = true;           // places are to be taken in this frame
  ImGuiTextFilter filter_;        // of the parameters
  std::string said_;              // what the menu did last
  int stacked_ = 0;               // profiler: 0 GPU times, 1 CPU times
};

}  // namespace weft::app::ui
