// Words that authors bring from other engines, APIs and shading languages, with what Weft and GLSL call the same thing.
// For hints: nothing is accepted that is not spelled as the format says.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace weft::base {

enum class Foreign : std::uint8_t {
  pass_key,     // of a pass stanza: "inputs"
  texture_key,  // of a texture: "format"
  graph_key,    // of a file: "nodes"
  state_word,   // of "state": "lequal"
  state_key,    // in "state": "ztest"
  value_type,   // of a parameter: "float4"
  value_key,    // in a parameter: "value"
  sampling,     // behind "as": "repeat"
  expression,   // a function in an expression: "round"
  shader_name,  // in GLSL: "saturate", "gl_FragColor"
  value,        // a name in an expression, or of an import: "time"
  import_type,  // of "import": "texture"
};

// What is to be written instead, as a hint ("write \"read\""), or "".
std::string hintForForeign(Foreign where, std::string_view word);

}  // namespace weft::base
