// A line with a bar while an environment is on its way; visible whether or not the panels are. Does not:
// load.
#pragma once

#include "app/live/live_environment.h"

namespace weft::app::ui {

void drawLoading(const LiveEnvironment& environment);

}  // namespace weft::app::ui
