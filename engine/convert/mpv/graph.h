// The graph of a user shader of mpv: which pass reads and writes what, as JSON. Does not: translate shaders.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/convert/mpv/blocks.h"
#include "engine/convert/text/converted.h"

namespace weft::convert {

struct MpvGraph {
  std::string text;                // the graph file
  std::set<std::string> bound;     // pictures that passes bind: HOOKED, MAIN, those of SAVE
  std::set<std::string> textures;  // and those of TEXTURE
  bool fragment = false, compute = false;
};

// `used`: names that the shader mentions, among them what mpv gives every shader. Empty after errors.
std::optional<MpvGraph> writeMpvGraph(const MpvFile& file, const std::set<std::string>& used,
                                      const std::string& name, const ConvertOptions& options,
                                      base::Diagnostics& diagnostics);

// mpv's own numbers that depend on sizes, which the graph sets where the shader mentions them.
inline constexpr const char* kMpvSizes[] = {"input_size", "target_size"};

}  // namespace weft::convert
