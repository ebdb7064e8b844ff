// Names of other programs and shading languages in the text of a shader: Shadertoy, ISF, three.js, Unity, Godot, Bonzomatic, HLSL, old
// GLSL. A part of foreign_words.cpp, not for others. Does not: know what the shader declares.
#pragma once

#include <span>
#include <string_view>

namespace weft::base {

// A word of others, and the hint that says what Weft or GLSL has in its place.
struct ForeignWord {
  std::string_view theirs, hint;
};

// As they are written there: GLSL tells cases apart.
std::span<const ForeignWord> foreignShaderNames();

}  // namespace weft::base
