// What a pass asks of the program cache: the stages, defines and outputs of a variant.
#pragma once

#include <cstdint>
#include <span>

#include "engine/gl/context/context.h"
#include "engine/gl/programs/program_cache.h"
#include "engine/graph/plan.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

// The vertex shader of a triangle over the whole picture. z = 0 is the far plane (reversed Z), so that a depth test "equal"
// against a cleared buffer finds the background.
extern const char* const kFullscreenVertex;

// The stages, defines and outputs of a pass's variant: what `check` compiles without running anything.
gl::ProgramRequest programRequestOf(const graph::FlatGraph& graph, const graph::Plan& plan,
                                    std::uint32_t pass, const graph::PassType& type);

// The columns of the table that a use reads; empty when the use reads no table.
std::span<const graph::TableColumn> columnsOf(const graph::FlatGraph& graph, const graph::FlatUse& use);
// The columns of the rows of the list that a draw pass draws.
std::vector<graph::TableColumn> instanceColumnsOf(const graph::PassSpec& spec);

// ---- whether the shaders of a pass agree with it: program_check.cpp ----
// Slots and parameters against what the shaders declare (glsl/interface.h), with a linked program and without. What the linked program
// alone knows comes on top: what the linker dropped is not asked for, and every thing that is left must be given. A name may be missing
// from a variant when another branch of an #if declares it.

// A program and the device that it is for.
struct LinkedProgram {
  const gl::Reflection& reflection;
  const gl::DeviceInfo& device;
};

// Reports W181 to W187 for slots and parameters, and W206 for work groups that the device does not allow; warns of W077. `linked`:
// null without OpenGL. False after an error.
bool checkProgram(const graph::Plan& plan, std::uint32_t pass, std::span<const gl::StageSource> stages,
                  std::span<const glsl::Define> defines, const LinkedProgram* linked,
                  text::Diagnostics& diagnostics);

// Warns of words that only the conditionals of the shaders have and that nothing defines, when a define or HAS_… of the pass is
// nearly that word, of a define that is 0 and only asked for by #ifdef, and of a define that is nearly a word of theirs (W187).
void warnOfConditions(const graph::PassSpec& pass, std::span<const gl::StageSource> stages,
                      std::span<const glsl::Define> defines, text::Diagnostics& diagnostics);

}  // namespace weft::runtime
