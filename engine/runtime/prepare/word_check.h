// Compares the slots and parameters of a pass with the words of its shaders, for those who have no OpenGL: the language
// server and `weft check --no-shaders`. Says what the check of the linked program (program_check.h) would say, as far as
// words tell: names that are not declared as what they must be, members of Parameters that the pass does not set, and
// formats of images (W181, W182, W183, W187). Does not: know types, or compile.
#pragma once

#include <span>
#include <string>

#include "engine/base/diagnostic.h"
#include "engine/graph/plan.h"
#include "engine/runtime/prepare/shader_words.h"

namespace weft::runtime {

// `stages` and `defines`: as programRequestOf() has them for the pass.
void checkWords(const graph::Plan& plan, std::uint32_t pass, std::span<const gl::StageSource> stages,
                std::span<const glsl::Define> defines, RoleCache& cache, base::Diagnostics& diagnostics);

// W083 for a pass that is not `always`, whose shaders read the time: it is 0 there.
void warnTimeless(const graph::FlatGraph& graph, std::uint32_t pass, const ShaderWords& words,
                  base::Diagnostics& diagnostics);

// W181 for each attached output that the fragment shader declares and never writes: its texels are undefined.
void warnUnwritten(const graph::Plan& plan, std::uint32_t pass, const ShaderWords& words,
                   base::Diagnostics& diagnostics);

// Warns (W187) of words in conditionals of the shaders that nothing defines and that look like a misspelt define of the pass:
// to a compiler they are 0, whatever the graph says. And of a define that is 0 and of which the shaders ask only whether it
// is defined. Once for each place, however many passes have the shader.
void warnOfConditions(const std::string& pass, std::span<const gl::StageSource> stages,
                      std::span<const glsl::Define> defines, base::Diagnostics& diagnostics);

}  // namespace weft::runtime
