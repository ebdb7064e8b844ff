// What the viewer draws over the picture besides the panels: the help with all keys, and the notice of a
// viewer that waits for files it can show. Between Overlay::begin() and end(). Does not: keep anything.
#pragma once

#include <span>

#include "engine/base/diagnostic.h"

namespace weft::app {

// The rows of keyBindings(), in as many columns and as small as the window asks for.
void drawHelp();
void drawWaiting(std::span<const base::Diagnostic> problems);

}  // namespace weft::app
