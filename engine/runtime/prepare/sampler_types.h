// What a GLSL sampler or image type can look at: its texture target and texel class, and whether a use of a graph
// resource fits it.
#pragma once

#include <glad/gl.h>

#include <string>
#include <string_view>

#include "engine/graph/flat_graph.h"

namespace weft::runtime {

struct OpaqueType {
  GLenum target = 0;       // GL_TEXTURE_2D, …; 0: a type the engine does not bind
  GLenum base = GL_FLOAT;  // GL_FLOAT, GL_INT, GL_UNSIGNED_INT
  bool shadow = false;
};
// Of "usampler2DArray" or "image2D".
OpaqueType opaqueTypeOf(std::string_view name);

// "" when it fits, else what is expected ("sampler2DArray", "an integer sampler", …).
std::string opaqueMismatch(const OpaqueType& type, const graph::FlatResource& resource,
                           const graph::FlatUse& use, bool compare);

}  // namespace weft::runtime
