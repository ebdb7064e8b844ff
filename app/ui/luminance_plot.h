// The scene's luminance as the outputs of graphs/post.json have it: `histogram` drawn over stops, `exposure`
// in EV with a marker at the mean luminance. Does not: wait for outputs, or make a graph have them.
#pragma once

#include <string_view>

#include "engine/runtime/frame/execution.h"

namespace weft::app::ui {

// Whether a dotted name ends in `name`: "post.histogram" is called "histogram".
bool isCalled(std::string_view dotted, std::string_view name);

// Fills what is left of the window. False, and nothing drawn, when the graph has no such histogram or none
// has arrived.
bool drawLuminance(runtime::Execution& execution);

}  // namespace weft::app::ui
