// Pictures that commands write: names with frame numbers, and the presented texture into them. Does not:
// decide which frames.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/base/diagnostic.h"
#include "engine/runtime/renderer.h"

namespace weft::app {

// "f_%04d.png" with the frame number; the name as it is when it has no pattern. Empty when the pattern is no
// such pattern.
std::optional<std::string> outputNameOf(const std::string& pattern, std::uint32_t frame);

// Whether frames can be written under `pattern`, from number `first` on; makes their folder. W180 if not.
bool checkOutput(const std::string& pattern, std::uint32_t first, bool several,
                 base::Diagnostics& diagnostics);

// The presented texture as it is: .png has 8 bits of it, .exr its values. False after errors.
bool savePresented(runtime::Renderer& renderer, const std::string& path, base::Diagnostics& diagnostics);

}  // namespace weft::app
