// What the viewer draws over the picture besides the panels: the help with all keys, the modes that are on, and the notice
// of a viewer that waits for files it can show. Between Overlay::begin() and end().
#pragma once

#include <span>
#include <string>

#include "engine/text/diagnostic.h"

namespace weft::app {

// The rows of keyBindings(), in as many columns and as small as the window asks for.
void drawHelp();
// One line in the upper left corner; nothing for an empty text.
void drawModes(const std::string& modes);
void drawWaiting(std::span<const text::Diagnostic> problems);

}  // namespace weft::app
