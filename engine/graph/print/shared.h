// What the dumps have in common: slot names of uses, framebuffers derived from attachments. Internal to
// engine/graph.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/graph/plan.h"

namespace weft::graph {

// Slot name per use; "" where the graph has none.
std::vector<std::string> slotNames(const FlatGraph& graph);

struct FramebufferText {
  std::uint32_t width = 0, height = 0;
  std::vector<std::string> color;  // as textOf(use), in slot order
  std::string depth;               // or ""
  bool empty() const { return color.empty() && depth.empty(); }
};

// The attachments that a pass's live uses make.
FramebufferText framebufferOf(const Plan& plan, std::uint32_t pass);

const char* nameOf(Target target);
const char* nameOf(Cadence cadence);

}  // namespace weft::graph
