// Reads graph files into a GraphDesc. Reports all mistakes at once: those of the file, of the files that it extends and
// of all files that it includes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/graph/desc.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

struct ReadOptions {
  std::span<const std::string> presets{};    // laid on top in this order (overlay.h)
  FileTexts given{};                         // of paths that are not looked for on disk
  std::uint64_t mostFileBytes = UINT64_MAX;  // of one file; fewer in an editor
};

// Reads `path` and its includes (paths relative to the including file). Comments are allowed. Null after an error that leaves
// nothing to expand; otherwise a description, perhaps partial, with the errors in `diagnostics`. A preset that cannot be read is
// an error and is left out.
std::shared_ptr<const GraphDesc> readGraph(const std::string& path, text::Diagnostics& diagnostics,
                                           const ReadOptions& options = {});

// The same for text that stands in memory; `name` is used in places, includes are relative to the folder of
// `name`.
std::shared_ptr<const GraphDesc> readGraphText(std::string_view text, const std::string& name,
                                               text::Diagnostics& diagnostics);

}  // namespace weft::graph
