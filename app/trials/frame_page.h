// The page of a frame, or of what differs between two: app/report/page.html with the data that its script draws.
#pragma once

#include <span>
#include <string>

#include "app/session/session.h"

namespace weft::app {

// Draws one or two `sides`, writes the page to `path` and says on it that `command` made it. Milliseconds of each step are medians over
// `repeats` frames; 0: no times. False after errors.
bool writeFramePage(gl::Context& context, const std::string& command, std::span<const Options> sides,
                    std::uint32_t repeats, const std::string& path, runtime::World& world,
                    text::Diagnostics& diagnostics);

}  // namespace weft::app
