// What the boxes of the panel of passes turn on and off.
#pragma once

#include <cstdint>
#include <string>

#include "engine/graph/expand/names/settings.h"
#include "engine/graph/flat_graph.h"

namespace weft::app::ui {

// What is given to --disable to turn the pass off: its name, or, when its file is included twice, the end of the name that
// means it in all of them. F8 could not write them apart.
std::string switchNameOf(const graph::FlatGraph& graph, std::uint32_t pass);

// What --disable or a box named, so that the pass can be turned on again; "" when something else turned it off.
std::string disabledBy(const graph::DisabledPass& pass, const graph::Settings& settings);

}  // namespace weft::app::ui
