// The parameters of a pass against the Parameters block of its program: each is a member, fits its type, and no member is
// left unset. A part of program_check.h, not for others.
#pragma once

#include <string>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/programs/program_cache.h"
#include "engine/graph/flat_graph.h"
#include "engine/runtime/prepare/shader_words.h"

namespace weft::runtime {

// W182, W184, W187. `shaders`: their paths, for messages. False after a report.
bool checkParameters(const graph::FlatGraph& graph, const graph::PassSpec& spec, const gl::Variant& variant,
                     const ShaderWords& words, const std::string& shaders, base::Diagnostics& diagnostics);

// The names that the sources of a variant declare, sorted, each once.
std::vector<std::string> declaredNames(const gl::Variant& variant);

}  // namespace weft::runtime
