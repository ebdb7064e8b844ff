// Writes parameters and the View block into uniform blocks, at the offsets that introspection reports. Layouts are the
// shader's; nothing here repeats a struct.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/gl/programs/program.h"
#include "engine/graph/language/value.h"
#include "engine/scene/camera.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

// Whether a member can hold the value: scalars and vectors, converted from double; a number fills a scalar, a list of n a
// vector of n. Otherwise says what is expected.
bool memberTakes(const gl::BlockMember& member, const graph::Value& value, std::string& expected);
// Writes the value at the member's offset. memberTakes() must hold; `block` is the block's first byte. For integers a value
// is cut to a whole number in range, and NaN is 0.
void writeValue(std::byte* block, const gl::BlockMember& member, const graph::Value& value);

// The names that the View block may declare (docs/shaders.md).
std::vector<std::string> viewMemberNames();
// Writes the members of `layout` that are view members. `viewport` (pixels) replaces the camera's. `timeless`: frame and
// times are 0, as for passes that are not `always`.
void writeView(std::byte* block, const gl::Block& layout, const scene::ViewData& view, glm::vec2 viewport,
               bool timeless);

}  // namespace weft::runtime
