// Names of other programs and shading languages in the text of a shader: Shadertoy, ISF, three.js, Unity, Godot, Bonzomatic, HLSL, old
// GLSL. Does not: know what the shader declares.
#pragma once

#include <string>
#include <string_view>

namespace weft::base {

// What Weft or GLSL has in its place, as a hint, or "". Exact: GLSL tells cases apart.
std::string hintForShaderName(std::string_view name);

}  // namespace weft::base
