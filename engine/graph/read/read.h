// Graph text to GraphDesc. Reports everything wrong in the file, in what it extends and in every file it
// includes, at once.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/diagnostic.h"
#include "engine/graph/desc.h"

namespace weft::graph {

// Reads `path` and its includes (paths relative to the including file). Comments are allowed. Null after an
// error that leaves nothing to expand; otherwise a description, perhaps partial, with the errors in
// `diagnostics`.
std::shared_ptr<const GraphDesc> readGraph(const std::string& path, base::Diagnostics& diagnostics);

// The same with presets on top, in this order (overlay.h). One that cannot be read is an error and left out.
std::shared_ptr<const GraphDesc> readGraph(const std::string& path, std::span<const std::string> presets,
                                           base::Diagnostics& diagnostics);

// The same with these texts in place of the files of these paths.
std::shared_ptr<const GraphDesc> readGraph(const std::string& path, std::span<const std::string> presets,
                                           const FileTexts& given, base::Diagnostics& diagnostics);

// The same for text that stands in memory; `name` is used in places, includes are relative to the folder of
// `name`.
std::shared_ptr<const GraphDesc> readGraphText(std::string_view text, const std::string& name,
                                               base::Diagnostics& diagnostics);

}  // namespace weft::graph
