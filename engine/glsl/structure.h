// The structure of a shader's tokens as far as it is counted: functions and who calls whom, nesting, cases of
// switches, elements of arrays. A part of shader_bounds, not for others.
#pragma once

#include <span>

#include "engine/glsl/bounds.h"
#include "engine/glsl/tokens.h"

namespace weft::glsl {

// Fills `inlined`, `depth`, `cases`, `array` and the circle.
void measureStructure(std::span<const Token> tokens, ShaderSize& size);

}  // namespace weft::glsl
