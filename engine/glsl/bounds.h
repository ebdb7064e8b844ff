// What a shader may be before a driver sees it: its bytes, its tokens after macros, its nesting. And which shaders are unusual, so
// that a process of its own tries them first. docs/limits.md says what drivers were measured to survive.
#pragma once

#include <cstdint>

#include "engine/base/diagnostic.h"
#include "engine/glsl/interface.h"
#include "engine/glsl/source.h"

namespace weft::glsl {

// Reports each count that is above its limit (W203). True when there is none.
bool checkShaderSize(const ShaderSize& size, const ShaderSource& source, base::Diagnostics& diagnostics);

// The same for a file so large that it is not read: `bytes` is above kMostShaderBytes.
void reportShaderBytes(std::uint64_t bytes, const base::Place& place, base::Diagnostics& diagnostics);

// Whether the driver may not survive the shader, or must work long.
bool isUnusual(const Interface& interface);

}  // namespace weft::glsl
