// Costs of a graph's frame in full-screen copies (graphs/bench_copy.json), both measured alternately in one run, so that
// the ratio means something on a busy machine too. Does not: judge, or compare with other programs.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/session/options.h"
#include "engine/base/diagnostic.h"

namespace weft::app {

// JSON: {"device", "size", "copy_ms", "variants": [{"name", "settings", "first_frame_ms", "frame_ms", "copies", "passes":
// [{"pass", "ms", "copies"}]}]}. Times are wall-clock milliseconds between glFinish, the least of all rounds; on software
// rasterisers "cpu_copies" is the same ratio in CPU time of the process, least of all rounds as well. Variants: "plain" (every
// bool parameter of the post chain off but fxaa), "default", and "all" (bloom, dof, auto_exposure, motion_blur and fxaa on, as far as the
// graph has them). Empty after errors.
std::optional<std::string> benchFrame(const Options& options, base::Diagnostics& diagnostics);

}  // namespace weft::app
