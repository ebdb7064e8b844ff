// Expands a GraphDesc to a FlatGraph: resolves includes, parameters, repeats, conditions, alternatives, disabled passes,
// versions and sizes, and makes every check of meaning. Uses no clock, no device and no files.
#pragma once

#include <memory>

#include "engine/graph/desc.h"
#include "engine/graph/expand/names/settings.h"
#include "engine/graph/flat_graph.h"
#include "engine/graph/registry.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

// The expanded graph, or null after errors; warnings do not prevent it. `diagnostics` may already have errors of the
// reader: then as much as possible is checked, and null is returned.
std::shared_ptr<const FlatGraph> expandGraph(const GraphDesc& desc, const Registry& registry,
                                             const Settings& settings, text::Diagnostics& diagnostics);

// An entry of Settings::sets, or of ::disables, that the graph does not take, and why.
struct Refusal {
  bool disable = false;
  std::size_t index = 0;
  text::Diagnostic why;
};
std::vector<Refusal> findRefused(const GraphDesc& desc, const Registry& registry, const Settings& settings);

}  // namespace weft::graph
