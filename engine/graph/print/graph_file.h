// A plan as a graph file: what is live in it, without includes, overlays, repeats, conditions, alternatives, parameters and
// disabled passes. The file gives the same plan. Names become plain: "post.bloom.down[2]" is "post_bloom_down_2", the
// second version of "hdr" is "hdr_v2". Parameters have become the numbers that they are; age() stays. Does not: carry
// shaders along, or lay the text out (engine/base/json/layout.h does).
#pragma once

#include <string>

#include "engine/graph/plan.h"

namespace weft::graph {

// The text of the file.
std::string graphFileOf(const Plan& plan);

}  // namespace weft::graph
