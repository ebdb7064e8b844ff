// Where in the files a parameter's value or a pass's "enabled" may be written, the best place first, as whole
// edited texts. Private to write_back.cpp, which tries them. Does not: know whether an edit has the effect it
// should.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/graph/desc.h"
#include "engine/graph/flat_graph.h"

namespace weft::graph {

struct TextEdit {
  std::string path, text;
};

// `wanted.value` for `wanted.path`; `paths` are the full names of all parameters.
std::vector<TextEdit> editsOfParameter(const GraphDesc& desc, std::span<const std::string> presets,
                                       const FileTexts& texts, const ParameterSpec& wanted,
                                       std::span<const std::string> paths);

// "enabled": false for the pass or include of this declared name.
std::vector<TextEdit> editsOfPass(const GraphDesc& desc, std::span<const std::string> presets,
                                  const FileTexts& texts, const std::string& pass);

// Full names of all passes, without indices, and of all includes, in order.
std::vector<std::string> declaredPasses(const GraphDesc& desc);

}  // namespace weft::graph
