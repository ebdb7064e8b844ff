// The viewer's panels: parameters, passes, texture inspector, frame profiler, storage, histogram, log. Each is made anew
// every frame from what it shows and keeps what a person chose in it; changes go straight into the LiveGraph.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/live/live_graph.h"
#include "app/ui/inspector_panel.h"
#include "app/ui/log.h"
#include "engine/graph/print/explain.h"
#include "engine/runtime/inspection/frame_profiler.h"
#include "engine/runtime/inspection/picture_histogram.h"

namespace weft::app::ui {

// Of the last item, where the mouse is over it.
void tooltip(const std::string& text);
void tooltip(const std::string& text, bool hovered);

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

  // In idle mode: what was chosen shows only in another frame of the graph.
  bool wantsFrame() const { return visible && open_[kInspector] && inspector_.wantsFrame(); }

  // Writes what was changed here into the files; says what it wrote in the log.
  void writeBack(text::Diagnostics& diagnostics);

 private:
  enum Panel : std::size_t { kParameters, kPasses, kInspector, kProfiler, kStorage, kHistogram, kPanelCount };

  void drawMenu(text::Diagnostics& diagnostics);
  void arrange();
  bool begin(Panel panel);
  void drawSummary(const runtime::FrameReport& report);
  void drawPasses(text::Diagnostics& diagnostics);
  void drawParameters(text::Diagnostics& diagnostics);
  void drawProfiler();
  void drawStorage();
  void drawHistogram();
  void drawLog();
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
  std::string search_;            // of the parameters
  std::string said_;              // what the menu did last
  bool gpuStack_ = true;          // profiler: stack GPU times, else CPU times
};

}  // namespace weft::app::ui
