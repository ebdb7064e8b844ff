// The graph file of an ISF file: parameters, resources and passes as JSON. Does not: translate shaders.
#pragma once

#include <optional>
#include <string>

#include "engine/convert/isf/header.h"
#include "engine/convert/isf/names.h"
#include "engine/convert/isf/shader.h"

namespace weft::convert {

// `file` stands in messages. Empty after errors.
std::optional<std::string> writeIsfGraph(const IsfHeader& header, IsfNames& names, const IsfShader& shader,
                                         const ConvertOptions& options, const base::Place& file,
                                         base::Diagnostics& diagnostics);

}  // namespace weft::convert
