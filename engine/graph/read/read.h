// Reads graph files into a GraphDesc. Reports all mistakes at once: those of the file, of the files that it extends and
// of all files that it includes.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/graph/desc.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

// A file with everything below it: each use of a file counts, because each is expanded for itself.
struct ReadFile {
  std::shared_ptr<const GraphDesc> graph;  // null when it could not be read
  std::uint64_t files = 1, values = 0;
  std::uint64_t depth = 1;  // of files in a row
};
// By path, with all that is below each: what graphs that are read in a row, while no file changes, need not read again.
using ReadFiles = std::map<std::string, ReadFile>;

struct ReadOptions {
  std::span<const std::string> presets{};    // laid on top in this order (overlay.h)
  FileTexts given{};                         // of paths that are not looked for on disk
  std::uint64_t mostFileBytes = UINT64_MAX;  // of one file; fewer in an editor
  // Takes files of graphs about which nothing is said. GraphDesc::texts lacks those that were in it, as do sums of values.
  ReadFiles* shared = nullptr;
};

// Reads `path` and its includes (paths relative to the including file). Comments are allowed. Null after an error that leaves
// nothing to expand; otherwise a description, perhaps partial, with the errors in `diagnostics`. A preset that cannot be read is
// an error and is left out.
std::shared_ptr<const GraphDesc> readGraph(const std::string& path, text::Diagnostics& diagnostics,
                                           const ReadOptions& options = {});

// The same for text in memory; `name` is used in places, and includes are relative to its folder.
std::shared_ptr<const GraphDesc> readGraphText(std::string_view text, const std::string& name,
                                               text::Diagnostics& diagnostics);

}  // namespace weft::graph
