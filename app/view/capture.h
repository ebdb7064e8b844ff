// The presented picture to files: screenshots. Does not: draw, or keep pictures.
#pragma once

#include <string>

#include "engine/base/diagnostic.h"
#include "engine/runtime/renderer.h"

namespace weft::app {

// Writes the presented texture as it is, without panels, and prints the name. False after errors.
bool saveScreenshot(runtime::Renderer& renderer, const std::string& path, base::Diagnostics& diagnostics);

}  // namespace weft::app
