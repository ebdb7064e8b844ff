// What a texture of each format can be used for in a graph, and the list of all formats. Does not: ask a driver; OpenGL 4.5 promises
// what is said here.
#pragma once

#include <string>

#include "engine/graph/language/format.h"

namespace weft::graph {

struct FormatUses {
  bool attachment = false;  // a pass renders to it, as color or depth
  bool blended = false;     // with "blend"
  bool filtered = false;    // "as linear"
  bool image = false;       // image load and store; the layout qualifier of GLSL is the format's name
};
FormatUses usesOf(Format format);

// A line for each format that a graph may name, below a heading: name, bytes of a texel, channels, what they hold, uses; of an image
// the layout qualifier.
std::string formatTable();

}  // namespace weft::graph
