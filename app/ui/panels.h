// The viewer's panels: passes, parameters, log. Each is made anew every frame from what it shows and keeps next to
// nothing; what a person changes goes straight into the LiveGraph. Does not: call OpenGL, know the window.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "app/live_graph.h"
#include "engine/graph/explain.h"

namespace weft::app::ui {

// What there is to say: about the files as they are, the environment last asked for, the last change made in the window, and what the driver or a
// frame said, once each.
struct Log {
  std::vector<base::Diagnostic> files, environment, change, past;
  void addPast(const base::Diagnostics& diagnostics);  // keeps the last hundred
};

class Panels {
 public:
  Panels(LiveGraph& live, runtime::Renderer& renderer, Log& log) : live_(live), renderer_(renderer), log_(log) {}

  bool visible = true;

  // Between Overlay::begin() and end(). `diagnostics` gets what a change that was made here led to.
  void draw(const runtime::FrameReport& report, base::Diagnostics& diagnostics);

 private:
  void drawSummary(const runtime::FrameReport& report);
  void drawPasses(base::Diagnostics& diagnostics);
  void drawParameters(base::Diagnostics& diagnostics);
  void drawLog() const;

  LiveGraph& live_;
  runtime::Renderer& renderer_;
  Log& log_;
  std::unique_ptr<graph::Explainer> explainer_;  // of the plan of `explained_`
  std::uint64_t explained_ = 0;
};

}  // namespace weft::app::ui
