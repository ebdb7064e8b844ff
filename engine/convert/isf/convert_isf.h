// An ISF file (Interactive Shader Format, versions 1 and 2) as a graph: inputs become parameters and images, passes
// passes, what persists a history. The shader keeps its lines: it becomes a file of its own, which a small stage file
// includes behind the declarations that ISF gives every shader (docs/importing.md). Does not: read or write files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/diagnostic.h"
#include "engine/convert/text/converted.h"

namespace weft::convert {

struct IsfSource {
  std::string_view fragment, vertex;  // the .fs, and the .vs where there is one
  std::string fragmentFile, vertexFile;
  bool hasVertex = false;
};

std::optional<Converted> convertIsf(const IsfSource& source, const ConvertOptions& options,
                                    base::Diagnostics& diagnostics);

}  // namespace weft::convert
