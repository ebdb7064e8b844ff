// Pipelines that were written for other programs, as graphs: ISF files and mpv's user shaders (docs/importing.md).
// What cannot be mapped is refused with a place and a code (W220 to W226). Does not: write files, or check the graph
// that comes out; `weft check` does.
#pragma once

#include <optional>
#include <string>

#include "engine/base/diagnostic.h"
#include "engine/convert/text/converted.h"

namespace weft::convert {

// Reads `path` and, for an ISF file, the .vs beside it. The kind comes from what the file says. An empty name in
// `options` becomes that of the file.
std::optional<Converted> convertFile(const std::string& path, ConvertOptions options,
                                     base::Diagnostics& diagnostics);

// The file's name as the name of a graph.
std::string nameForFile(const std::string& path);
// Where the vertex shader of an ISF file would stand.
std::string vertexFileOf(const std::string& path);

}  // namespace weft::convert
