// Counts how large a shader is, before the driver sees it, in what crashes or stalls drivers: tokens (after macros, and
// with every call replaced by its function), nesting, cases, elements of arrays. docs/limits.md says what drivers were
// measured to survive. A loop counts once, however often it runs. Pure text work: needs no context. Does not: parse
// GLSL. The count of a wrong text means nothing, and the compiler says what is wrong.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/base/limits.h"
#include "engine/glsl/source.h"

namespace weft::glsl {

// A count, and where in the text the thing that has it begins (from 1).
struct ShaderCount {
  std::uint64_t count = 0;
  std::uint32_t line = 0, column = 0;
  std::string name;  // of the macro, function or variable, or empty
};

struct ShaderSize {
  ShaderCount tokens;   // after macros; counting ends above the limit
  ShaderCount inlined;  // of all functions, once calls are replaced by what they call; named is the largest
  ShaderCount depth;    // brackets, blocks and operators around one another
  ShaderCount cases;    // of one switch
  ShaderCount array;    // elements of one variable outside blocks
  std::uint64_t bytes = 0;
  std::uint64_t allCases = 0, allElements = 0;  // of all switches and all arrays together
  bool uncertain = false;                       // some of it could not be counted
  // Functions that call each other in a circle, the first one again at the end; empty: none is seen.
  // Overloads of one name and number of arguments are not told apart, so a circle is only one where the
  // driver says so too.
  std::vector<std::string> circle;
  ShaderCount circleAt;
};

ShaderSize measureShader(const ShaderSource& source, std::span<const Define> defines);

// Reports each count that is above its limit (W203). True when there is none.
bool checkShaderSize(const ShaderSize& size, const ShaderSource& source, base::Diagnostics& diagnostics);

// The same for a file so large that it is not read: `bytes` is above Limit::shader_bytes.
void reportShaderBytes(std::uint64_t bytes, const base::Place& place, base::Diagnostics& diagnostics);

// Whether some count comes near enough to its limit that the driver may not survive the shader, or must work
// long.
bool isUnusual(const ShaderSize& size);
// The largest share that a count has of its limit, and which limit that is: 1 is at the limit. A limit that
// was raised counts as it is by default, since what the driver survives stays the same.
struct ShaderShare {
  base::Limit limit = base::Limit::shader_tokens;
  double share = 0;
};
ShaderShare largestShare(const ShaderSize& size);

}  // namespace weft::glsl
