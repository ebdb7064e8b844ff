// Words that authors bring from other engines, APIs and shading languages, with what Weft and GLSL call the same thing.
// For hints: nothing is accepted that is not spelled as the format says. The table is foreign.json beside
// this file, read from the data folder when the first hint is asked for; without it there are no such hints.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace weft::text {

enum class Foreign : std::uint8_t {
  graph_key,        // of a file: "nodes"
  pass_key,         // of a pass stanza: "inputs"
  texture_key,      // of a texture: "format"
  state_key,        // in "state": "ztest"
  state_word,       // of "state": "lequal"
  value_key,        // in a parameter: "value"
  value_type,       // of a parameter: "float4"
  sampling,         // behind "as": "repeat"
  expression,       // a function in an expression: "round"
  value,            // a name in an expression, or of an import: "time"
  import_type,      // of "import": "texture"
  import_argument,  // of an import that reads a file: "url"
  pass_type,        // of a pass: "raster"
  shader_name,      // in GLSL: "saturate", "gl_FragColor"
  format,           // of a texture: "R16G16B16A16_FLOAT"; the hint is ours, or the nearest that Weft has
};

// What is to be written instead of a word. All is empty of a word that nobody knows.
struct ForeignWord {
  std::string hint;        // "write \"size\": [width, height]"
  std::string key;         // our key for a key: "size"; "" where there is no single one
  bool isOnlyKey = false;  // it means the same as our key, under another name
};
const ForeignWord& findForeignWord(Foreign where, std::string_view word);
inline std::string hintForForeign(Foreign where, std::string_view word) {
  return findForeignWord(where, word).hint;
}

}  // namespace weft::text
