// Checks whether a shader agrees with the pass that names it: compares slots and parameters with introspection of the
// program. A name may be missing there when the source declares it: then the linker dropped it. Does not: compile.
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/gl/programs/program_cache.h"
#include "engine/graph/plan.h"
#include "engine/runtime/prepare/shader_words.h"

namespace weft::runtime {

// Reports W181 to W187 for slots and parameters, and W206 for work groups that the device does not allow. False after a
// report. `roles` keeps what is scanned of the sources, for the next check of a program that has them too.
bool checkProgram(const graph::Plan& plan, std::uint32_t pass, const gl::Variant& variant,
                  const gl::Limits& limits, RoleCache& roles, base::Diagnostics& diagnostics);

}  // namespace weft::runtime
