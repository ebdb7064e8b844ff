// Values into uniform and storage blocks at the offsets that introspection reports: parameters, the View block. Layouts are the shader's; nothing here repeats a struct.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/programs/program.h"
#include "engine/graph/language/value.h"
#include "engine/scene/camera.h"

namespace weft::runtime {

// Whether a member can hold the value: scalars and vectors, converted from double; a number fills a scalar, a list of n a
// vector of n. Otherwise says what is expected.
bool memberTakes(const gl::BlockMember& member, const graph::Value& value, std::string& expected);
// memberTakes must hold. `block` starts at the block's first byte.
void writeValue(std::byte* block, const gl::BlockMember& member, const graph::Value& value);

// Names the View block may declare (docs/shaders.md).
std::vector<std::string> viewMemberNames();
bool isViewMember(std::string_view name);
// `viewport` replaces the camera's; passes that are not `always` see no time.
void writeView(std::byte* block, const gl::Block& layout, const scene::ViewData& view, glm::vec2 viewport,
               bool timeless);

}  // namespace weft::runtime
