// Turns the graph's formats, targets and barrier bits into GL enums. No other file knows both.
#pragma once

#include <glad/gl.h>

#include <array>
#include <cstdint>

#include "engine/graph/flat_graph.h"
#include "engine/graph/plan.h"

namespace weft::runtime {

GLenum glFormatOf(graph::Format format);  // sized internal format
GLenum glTargetOf(graph::Target target);
GLbitfield glBarriersOf(std::uint16_t barriers);
GLenum glCompareOf(graph::Compare compare);

// As what the bits of a texel come and go unchanged: the format of a view of the texture, and the client's format and type.
struct ExactTexel {
  GLenum view = GL_NONE, format = GL_NONE, type = GL_NONE;
};
ExactTexel exactTexelOf(graph::Format format);

// One texel for glClearTexImage: a number fills every channel, a list gives them in order with 0 for the missing ones;
// a depth-stencil list is [depth, stencil].
struct ClearTexel {
  GLenum format = GL_NONE, type = GL_NONE;
  alignas(16) std::array<std::uint8_t, 16> bytes{};
};
ClearTexel clearTexelOf(graph::Format format, const graph::Value& value);
// The same value as four floats.
std::array<float, 4> clearChannelsOf(const graph::Value& value);

}  // namespace weft::runtime
