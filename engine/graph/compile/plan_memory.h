// What a plan would allocate, held against the limit before anything is. What a device has is not known here.
#pragma once

#include "engine/base/diagnostic.h"
#include "engine/graph/plan.h"

namespace weft::graph {

constexpr std::uint64_t kMostTextureBytes = 4ull << 30;  // of all textures and buffers of one plan

// False after Code::texturesTooLarge, at the declaration of the largest texture or buffer.
bool checkMemory(const Plan& plan, base::Diagnostics& diagnostics);

}  // namespace weft::graph
