// What an edit costs until the next frame may start, as the viewer makes it (app/live/live_graph.h): a live
// parameter, a structural one, a saved file. CPU time of the calling thread, with every program cached,
// without drawing: only before the first edit are there frames. Does not: judge, or write a file.
#pragma once

#include <optional>
#include <string>

#include "app/session/options.h"
#include "engine/base/diagnostic.h"

namespace weft::app {

// JSON: {"graph", "device", "size", "live_parameters", "live_us", "live_worst_us", "live_allocations",
// "live_plans_built", "toggles", "toggle_us", "toggle_worst_us", "toggle_worst", "toggle_allocations",
// "save_us", "save_allocations"}. A live change: the median over all live parameters of one value more;
// allocations and plans are those of the worst of them. A toggle: the median over every structural boolean,
// on and off. A save: all files of the graph are read again, as after a change of any, with the bytes they
// have; nothing is left out because they are the same. Empty after errors.
std::optional<std::string> benchEdits(const Options& options, base::Diagnostics& diagnostics);

}  // namespace weft::app
