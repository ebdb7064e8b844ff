// Words that GLSL 4.5 keeps for itself, so that what a graph names does not hide them. foreign_words.h translates those of
// versions before.
#pragma once

#include <span>
#include <string_view>

namespace weft::text {

// Whether GLSL 4.5 keeps the word: a keyword, a type, or one that is reserved. Nothing in a shader can have such a name.
bool isGlslWord(std::string_view word);

// The functions that GLSL 4.5 has by itself, sorted.
std::span<const std::string_view> glslFunctions();
// One of them: a define of that name would hide it.
bool isGlslFunction(std::string_view word);

}  // namespace weft::text
