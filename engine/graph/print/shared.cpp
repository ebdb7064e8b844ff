#include "engine/graph/print/shared.h"

#include <algorithm>

#include "engine/graph/print/explain.h"

namespace weft::graph {

std::vector<std::string> slotNames(const FlatGraph& graph) {
  std::vector<std::string> names(graph.uses.size());
  for (const SlotSpec& slot : graph.slots)
    for (std::uint32_t i = 0; i < slot.useCount && slot.firstUse + i < names.size(); ++i)
      names[slot.firstUse + i] = slot.array ? slot.name + "[" + std::to_string(i) + "]" : slot.name;
  for (const SlotSpec& slot : graph.slots)
    if (slot.firstValue != kNone) names[slot.firstValue] = slot.name + " (first)";
  return names;
}

FramebufferText framebufferOf(const Plan& plan, std::uint32_t pass) {
  FramebufferText framebuffer;
  const FlatGraph& graph = *plan.graph;
  const FlatPass& p = graph.passes[pass];
  for (std::uint32_t u = p.firstUse; u < p.firstUse + p.useCount; ++u) {
    const FlatUse& use = graph.uses[u];
    if (plan.attached[u] == 0 || (use.kind != Kind::color && use.kind != Kind::depth)) continue;
    const FlatResource& r = graph.resources[use.resource];
    if (framebuffer.empty()) {
      framebuffer.width = std::max(1u, r.width >> use.mip);
      framebuffer.height = std::max(1u, r.height >> use.mip);
    }
    if (use.kind == Kind::color)
      framebuffer.color.push_back(textOf(graph, use));
    else
      framebuffer.depth = textOf(graph, use);
  }
  return framebuffer;
}

const char* nameOf(Target target) {
  switch (target) {
    case Target::texture_2d:
      return "2d";
    case Target::texture_2d_array:
      return "2d_array";
    case Target::texture_cube:
      return "cube";
    case Target::texture_cube_array:
      return "cube_array";
    case Target::texture_3d:
      return "3d";
    case Target::texture_2d_multisample:
      return "2d_multisample";
  }
  return "";
}

const char* nameOf(Cadence cadence) {
  return cadence == Cadence::always ? "always" : cadence == Cadence::on_change ? "on_change" : "once";
}

}  // namespace weft::graph
