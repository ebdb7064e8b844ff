// GLSL as it was written for older versions and for WebGL, made GLSL 4.5, token by token: texture2D and its kin,
// varying, gl_FragColor, names that have become words of the language. Does not: know types; what cannot be said in
// 4.5 is reported (W224).
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/base/diagnostic.h"
#include "engine/convert/text/glsl_text.h"

namespace weft::convert {

enum class Stage : std::uint8_t { vertex, fragment };

// `output`: what gl_FragColor and gl_FragData[0] become. #version, #extension and #line become blank.
void modernize(GlslText& text, Stage stage, std::string_view output, const base::Place& file,
               base::Diagnostics& diagnostics);

// Whether an older GLSL lets a variable have the name and 4.5 does not: 'sample', 'buffer', 'shared'.
bool isNewWord(std::string_view word);

// Names that the text declares outside its functions and that `taken` holds get a '_' behind them, everywhere.
void renameTaken(GlslText& text, std::span<const std::string> taken);

}  // namespace weft::convert
