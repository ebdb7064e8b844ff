// A line with a bar for each of environment and scene while it is on its way; visible whether or not the panels are. Does
// not: load.
#pragma once

#include "app/live/live_graph.h"

namespace weft::app::ui {

void drawLoading(const LiveGraph& live);

}  // namespace weft::app::ui
