// What every command that renders trials begins and ends with: the world, a context, and the report. Does not: render.
#pragma once

#include <functional>
#include <span>

#include "app/session/device_session.h"
#include "app/session/options.h"

namespace weft::app {

// Calls `run`, which returns the exit code, and reports. `wrong`: the exit code after errors; a graph of `all` that is wrong is
// refused before OpenGL is opened. 3 without OpenGL. The first of `all` says which world and which device.
int runOnDevice(std::span<const Options> all, int wrong,
                const std::function<int(gl::Context&, const runtime::World&, base::Diagnostics&)>& run);

}  // namespace weft::app
