// What a shader would have to declare, as GLSL, so that it fits what its pass says: the fix in messages about slots and
// parameters. Does not: check anything.
#pragma once

#include <string>

#include "engine/graph/flat_graph.h"

namespace weft::runtime {

// "uniform usampler2DArray maps;", "layout(rgba16f) uniform writeonly image2D result;", "out vec4 result;", …: what the
// shader declares for a slot of `kind` that holds `use` of `resource`.
std::string declarationFor(const graph::SlotSpec& slot, graph::Kind kind, const graph::FlatUse& use,
                           const graph::FlatResource& resource);

// "float", "vec3" or "bool": the member of the Parameters block for such a value.
std::string memberTypeFor(const graph::Value& value);

}  // namespace weft::runtime
