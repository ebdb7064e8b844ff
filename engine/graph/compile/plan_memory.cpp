// Declared in compile.h.
#include <fmt/format.h>

#include "engine/graph/compile/compile.h"
#include "engine/graph/subresource.h"
#include "engine/text/limits.h"

namespace weft::graph {

bool checkMemory(const Plan& plan, text::Diagnostics& diagnostics) {
  const std::uint64_t most = text::raised(kMaxTextureBytes);
  if (plan.bytesAllocated <= most) return true;
  const FlatGraph& graph = *plan.graph;
  const auto bytesOf = [&](std::uint32_t r) {
    const bool own = !isImported(graph.resources[r]) && plan.firstStep[r] != kNone;
    return own ? graph.resources[r].bytes * plan.copiesOf(r) : 0;
  };
  std::uint32_t largest = 0;
  for (std::uint32_t r = 1; r < graph.resources.size(); ++r)
    if (bytesOf(r) > bytesOf(largest)) largest = r;
  text::Diagnostic& d =
      diagnostics.error(text::Code::texturesTooLarge,
                        largest < graph.resourcePlaces.size() ? graph.resourcePlaces[largest] : text::Place{},
                        fmt::format("the textures and buffers of '{}' need {} bytes, more than they may",
                                    graph.name, plan.bytesAllocated));
  d.resource = graph.resourceNames[largest];
  d.expected = fmt::format("at most {} bytes", most);
  d.found = fmt::format("the largest is '{}', {} bytes", d.resource, bytesOf(largest));
  d.hint = "make them smaller or keep less history";
  if (const std::string raise = text::hintToRaise(kMaxTextureBytes, plan.bytesAllocated); !raise.empty())
    d.hint += "; " + raise;
  return false;
}

}  // namespace weft::graph
