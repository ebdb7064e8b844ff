// Slow and simple second opinions on a plan: liveness by repeating until nothing changes, alive sets step by
// step. Each returns "" or what is wrong.
#pragma once

#include <string>

#include "engine/graph/plan.h"

namespace weft::graph::checks {

std::string checkLiveness(const Plan& plan);

// Textures: storages are of their resources' class; two resources alive in one step never share; the bytes
// allocated are those of the greatest number alive at once, per class. Buffers: no overlap while alive,
// aligned, inside the arena.
std::string checkStorage(const Plan& plan);

// A use sees the version that it sees in declared order; live passes run once, culled ones never.
std::string checkOrder(const Plan& plan);

}  // namespace weft::graph::checks
