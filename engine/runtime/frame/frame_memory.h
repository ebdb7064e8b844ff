// Finds what a frame may depend on besides the plan and the world: the frames before it, and the mouse. Does not: run
// anything.
#pragma once

#include <span>

#include "engine/graph/plan.h"
#include "engine/runtime/imports/imports.h"
#include "engine/runtime/prepare/prepared_pass.h"

namespace weft::runtime {

// Whether a frame may differ by which frames ran before it: by a live history, by an import that remembers, or by what is
// kept and was made of something that moves. If not, headless frame n may be the first to run. `passes` has one for each step.
bool remembersFrames(const graph::Plan& plan, std::span<const PreparedPass> passes, Imports& imports,
                     const World& world);
// Whether a step reads an import that follows the mouse.
bool readsPointer(const graph::Plan& plan, Imports& imports);

}  // namespace weft::runtime
