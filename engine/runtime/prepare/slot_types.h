// Which GLSL type fits what a slot or parameter holds, and what a shader would have to declare for it: the fix in messages.
#pragma once

#include <string>

#include "engine/gl/programs/program.h"
#include "engine/graph/flat_graph.h"

namespace weft::runtime {

// "" when a sampler or image type fits, else what is expected ("a 2DArray type", "an unsigned int type", …). `type`: null for
// one that the engine does not bind.
std::string opaqueMismatch(const gl::GlslType* type, const graph::FlatResource& resource,
                           const graph::FlatUse& use, bool compare);

// "uniform usampler2DArray maps;", "layout(rgba16f) uniform writeonly image2D result;", "out vec4 result;", …: what the
// shader declares for a slot of `kind` that holds `use` of `resource`.
std::string declarationFor(const graph::SlotSpec& slot, graph::Kind kind, const graph::FlatUse& use,
                           const graph::FlatResource& resource);

// "float", "vec3" or "bool": the member of the Parameters block for such a value.
std::string memberTypeFor(const graph::Value& value);

}  // namespace weft::runtime
