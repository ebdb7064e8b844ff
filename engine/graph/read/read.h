// Reads graph files into a GraphDesc. Reports all mistakes at once: those of the file, of the files that it extends and
// of all files that it includes.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/graph/desc.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

inline std::uint64_t mostFileBytes = ~0ull;  // of one file; fewer in an editor

// Reads `path` and its includes (paths relative to the including file), with presets on top, in this order (overlay.h). Takes
// the text of a file from `given` where that has its path. Comments are allowed. Null after an error that leaves nothing to
// expand; otherwise a description, perhaps partial, with the errors in `diagnostics`. A preset that cannot be read is an error
// and is left out.
std::shared_ptr<const GraphDesc> readGraph(const std::string& path, std::span<const std::string> presets,
                                           const FileTexts& given, text::Diagnostics& diagnostics);
inline std::shared_ptr<const GraphDesc> readGraph(const std::string& path,
                                                  std::span<const std::string> presets,
                                                  text::Diagnostics& diagnostics) {
  return readGraph(path, presets, {}, diagnostics);
}
inline std::shared_ptr<const GraphDesc> readGraph(const std::string& path, text::Diagnostics& diagnostics) {
  return readGraph(path, {}, {}, diagnostics);
}

// The same for text that stands in memory; `name` is used in places, includes are relative to the folder of
// `name`.
std::shared_ptr<const GraphDesc> readGraphText(std::string_view text, const std::string& name,
                                               text::Diagnostics& diagnostics);

}  // namespace weft::graph
