// The shaders of an mpv user shader: its text with the headers as #if, so that lines keep their numbers, and what mpv
// gives every pass. Does not: know the graph's resources.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "engine/convert/mpv/blocks.h"
#include "engine/convert/mpv/graph.h"
#include "engine/convert/text/converted.h"

namespace weft::convert {

// The text that the stage files include.
std::string translateMpvText(const MpvFile& file);

// The names that the shader mentions without mpv's endings: HOOKED of HOOKED_texOff. And those without one.
std::set<std::string> namesMentioned(const std::string& text);

std::vector<ConvertedText> writeMpvShaders(const MpvFile& file, const MpvGraph& graph,
                                           const std::string& text, const std::set<std::string>& used,
                                           const std::string& name);

}  // namespace weft::convert
