// What every command that renders trials begins and ends with: the world, a context, and the report. Does not: render.
#pragma once

#include <functional>

#include "app/session/device_session.h"
#include "app/session/options.h"

namespace weft::app {

// Calls `run`, which returns the exit code, and reports. `wrong`: the exit code after errors. 3 without OpenGL; mistakes in the
// graph are reported then, too.
int runOnDevice(const Options& options, int wrong,
                const std::function<int(gl::Context&, const runtime::World&, base::Diagnostics&)>& run);

}  // namespace weft::app
