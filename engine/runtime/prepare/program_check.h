// Checks whether the shaders of a pass agree with it: slots and parameters against what the shaders declare (glsl/interface.h), with a
// linked program and without. What the linked program alone knows comes on top: what the linker dropped is not asked for, and
// every thing that is left must be given. A name may be missing from a variant when another branch of an #if declares it.
#pragma once

#include <span>
#include <string>

#include "engine/gl/context/context.h"
#include "engine/gl/programs/program.h"
#include "engine/graph/plan.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

// A program and the device that it is for.
struct LinkedProgram {
  const gl::Reflection& reflection;
  const gl::Limits& limits;
};

// Reports W181 to W187 for slots and parameters, and W206 for work groups that the device does not allow; warns of W077. `linked`:
// null without OpenGL. False after an error.
bool checkProgram(const graph::Plan& plan, std::uint32_t pass, std::span<const gl::StageSource> stages,
                  std::span<const glsl::Define> defines, const LinkedProgram* linked,
                  text::Diagnostics& diagnostics);

// Warns of words that only the conditionals of the shaders have and that nothing defines, when a define or HAS_… of the pass is
// nearly that word, of a define that is 0 and only asked for by #ifdef, and of a define that is nearly a word of theirs
// (W187).
void warnOfConditions(const graph::PassSpec& pass, std::span<const gl::StageSource> stages,
                      std::span<const glsl::Define> defines, text::Diagnostics& diagnostics);

}  // namespace weft::runtime
