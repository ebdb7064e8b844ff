// What the boxes of the panel of passes turn on and off.
#pragma once

#include <cstdint>
#include <string>

#include "engine/graph/expand/names/settings.h"
#include "engine/graph/flat_graph.h"
#include "engine/graph/language/suffix.h"

namespace weft::app::ui {

// What is given to --disable to turn the pass off: its name, or, when its file is included twice, the end of the name that
// means it in all of them. F8 could not write them apart.
inline std::string switchNameOf(const graph::FlatGraph& graph, std::uint32_t pass) {
  const graph::PassSpec& spec = graph.specs[pass];
  std::string name = spec.declared;
  for (const graph::PassSpec& other : graph.specs)
    if (other.place == spec.place) name = graph::commonSuffix(name, other.declared);
  return name;
}

// What --disable or a box named, so that the pass can be turned on again; "" when something else turned it off.
inline std::string disabledBy(const graph::DisabledPass& pass, const graph::Settings& settings) {
  for (const graph::Disable& disable : settings.disables)
    if (graph::sourceOf(disable) == pass.why) return disable.name;
  return {};
}

}  // namespace weft::app::ui
