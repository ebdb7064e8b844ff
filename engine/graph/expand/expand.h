// Expands a GraphDesc to a FlatGraph: resolves includes, parameters, repeats, conditions, alternatives, disabled passes,
// versions and sizes, and makes every check of meaning. Uses no clock, no device and no files.
#pragma once

#include <memory>
#include <string>
#include <vector>

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

// Every name in the files of a graph, and where it is declared, by the scopes of expansion: for editors.

struct NameUse {
  enum class Kind : std::uint8_t { resource, variable, pass, set };  // pass: also the prefix of an include
  Kind kind = Kind::resource;
  std::string name;  // one part of a dotted name
  std::string full;  // what it means, as a plan calls it; "@sun" of an import that no file declares
  Place place;       // of the first character
  bool key = false;  // of an item of a list "bind", what it is bound to; what it names is another use here
  // Of the first character of the declaration; without a file where there is none. An include without "as" is declared by
  // the opening quote of its path.
  Place declared;
};

// In each file once, by file, place and `key`, with declarations. Names that mean nothing are left out; mistakes do no harm.
std::vector<NameUse> findNameUses(const GraphDesc& desc, const Registry& registry);

}  // namespace weft::graph
