// Whether a frame may differ by which frames ran before it: a live history, an import that remembers, or something kept that was made of what moves.
// If not, headless frame n may be the first to run.
#pragma once

#include <span>

#include "engine/graph/plan.h"
#include "engine/runtime/imports/imports.h"
#include "engine/runtime/prepare/prepared_pass.h"

namespace weft::runtime {

// `passes` per step of the plan.
bool remembersFrames(const graph::Plan& plan, std::span<const PreparedPass> passes, Imports& imports,
                     const World& world);

}  // namespace weft::runtime
