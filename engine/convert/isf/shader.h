// The shaders of an ISF file: the text of the file, translated in place, and what Weft puts before it. Does not: know
// the graph.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "engine/convert/isf/convert_isf.h"
#include "engine/convert/isf/header.h"
#include "engine/convert/isf/names.h"

namespace weft::convert {

struct IsfShader {
  std::vector<ConvertedText> texts;
  std::string fragment, vertex;  // paths below shaders/; `vertex` is empty without one
  // Images that the shader reads, by their names in the file, and those of them that stand elsewhere than in the functions
  // of ISF, so that they must always be there.
  std::set<std::string, std::less<>> read, needed;
  bool usesDate = false;
};

// Empty after errors.
std::optional<IsfShader> translateIsfShader(const IsfSource& source, const ConvertOptions& options,
                                            const IsfHeader& header, const IsfNames& names,
                                            base::Diagnostics& diagnostics);

// The slot of what the shader draws.
constexpr std::string_view kIsfOutput = "isf_FragColor";

}  // namespace weft::convert
