// The structure of a shader's tokens as far as it is counted: functions and who calls whom, nesting, cases of
// switches, elements of arrays. A part of shader_bounds, not for others.
#pragma once

#include <span>

#include "engine/gl/shaders/bounds.h"
#include "engine/gl/shaders/tokens.h"

namespace weft::gl {

// Fills `inlined`, `depth`, `cases`, `array` and the circle.
void measureStructure(std::span<const Token> tokens, ShaderSize& size);

}  // namespace weft::gl
