// Times the tasks of the CPU's frame, on one thread and on two: where the meshes of a scene are, and what views see of them.
// Both take the same frames in turns, so that a busy machine is as busy for the one as for the other, and what they make is
// compared byte for byte in every tenth. Does not: touch GL, or judge the numbers.
#pragma once

#include <optional>
#include <string>

#include "app/session/options.h"
#include "engine/base/diagnostic.h"

namespace weft::app {

// JSON: {"scene", "instances", "moving_nodes", "frames", "views": [...], "same_bytes", "runs": [{"threads", "frame_us",
// "cpu_us", "stages": [{"stage", "us", "cpu_us"}]}]}. Microseconds of a frame: "us" by the clock on the wall, the least of all
// frames; "cpu_us" of all threads together, the median of all frames. The scene is scenes/crowd.json unless the options name
// one. Empty after errors.
std::optional<std::string> benchTasks(const Options& options, base::Diagnostics& diagnostics);

}  // namespace weft::app
