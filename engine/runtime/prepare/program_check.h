// Whether a shader agrees with the pass that names it: slots and parameters held against introspection of its program.
// Declared names must stand in the source; those that the linker dropped are fine.
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/gl/programs/program_cache.h"
#include "engine/graph/plan.h"
#include "engine/runtime/prepare/shader_words.h"

namespace weft::runtime {

// Holds the slots and parameters of a pass against its program (W181 to W187), and its work groups against the device
// (W206). `roles` keeps what it scans of the sources, for the next check of a program that has them too.
bool checkProgram(const graph::Plan& plan, std::uint32_t pass, const gl::Variant& variant,
                  const gl::Limits& limits, RoleCache& roles, base::Diagnostics& diagnostics);

}  // namespace weft::runtime
