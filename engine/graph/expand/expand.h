// GraphDesc to FlatGraph: scopes of includes, parameters, repeats, conditions, alternatives, disabled passes,
// renames, versions, sizes and every check of the design's "Diagnostics". Pure: no clock, no device, no
// files.
#pragma once

#include <memory>

#include "engine/base/diagnostic.h"
#include "engine/graph/desc.h"
#include "engine/graph/expand/names/settings.h"
#include "engine/graph/flat_graph.h"
#include "engine/graph/registry.h"

namespace weft::graph {

// The expanded graph, or null after errors. Warnings leave a graph. `diagnostics` may hold errors of the
// reader already: then everything is checked as far as it goes, and null is returned.
std::shared_ptr<const FlatGraph> expandGraph(const GraphDesc& desc, const Registry& registry,
                                             const Settings& settings, base::Diagnostics& diagnostics);

// An entry of Settings::sets, or of ::disables, that the graph does not take, and why.
struct Refusal {
  bool disable = false;
  std::size_t index = 0;
  base::Diagnostic why;
};
std::vector<Refusal> findRefused(const GraphDesc& desc, const Registry& registry, const Settings& settings);

}  // namespace weft::graph
