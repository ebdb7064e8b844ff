// What the page of `weft report` shows of one frame, as JSON: the plan, and what each step of the frame left.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/assets/images/image.h"
#include "engine/graph/plan.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/inspection/inspector.h"

namespace weft::app {

// Without the data folder, so that a page does not depend on where Weft is.
std::string withoutFolder(const std::string& path);

class FrameLook {
 public:
  // Of the plan that `renderer`, which must outlive this, runs now.
  explicit FrameLook(runtime::Renderer& renderer) : renderer_(renderer) {}
  // Before the frame. `diagnostics` must outlive it.
  void begin(text::Diagnostics& diagnostics);
  // After it. `facts`: words that tell the frame from others; `said`: messages of the graph.
  nlohmann::ordered_json end(const std::string& title, const std::vector<std::string>& facts,
                             const text::Diagnostics& said);
  const graph::Plan& plan() const { return plan_; }
  const assets::Image8& picture() const { return picture_; }

 private:
  runtime::Renderer& renderer_;
  graph::Plan plan_ = renderer_.execution()->plan();
  runtime::Inspector inspector_{renderer_.device()};
  nlohmann::ordered_json outputs_;
  assets::Image8 picture_;
};

}  // namespace weft::app
