// What an author can type to mend what a compiler says of types and names.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/glsl/source.h"

namespace weft::gl {

// Of Mesa's "… of type vec4 cannot be assigned to variable of type vec3": what makes one of the other, or "".
std::string fixForAssignment(std::string_view message);

// Whether the graph gives a name to the shader as a slot or a parameter: then its HAS_… is among the defines.
bool isGiven(std::string_view name, std::span<const glsl::Define> defines);

}  // namespace weft::gl
