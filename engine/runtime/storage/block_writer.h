// Writes parameters and the View block into uniform blocks, at the offsets that introspection reports. Layouts are the
// shader's; nothing here repeats a struct.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/gl/programs/program.h"
#include "engine/graph/flat_graph.h"
#include "engine/scene/camera.h"

namespace weft::runtime {

// Where a value lies in a block: `rows` scalars, the first at `offset`, each `step` bytes behind the one before.
struct Field {
  std::uint32_t offset = 0;
  GLenum base = GL_FLOAT;  // as gl::GlslType
  std::uint32_t rows = 1, step = 4;
  // A number for one row, a list of n for n.
  bool takes(const graph::Value& value) const {
    return value.type == graph::Value::Type::list ? value.count == rows : value.isNumeric() && rows == 1;
  }
};
// The field of a member that a uniform's value is for; the fields of an array are its elements, those of a matrix its columns, and
// a list of numbers may also fill an array of them. Nothing where the member holds no such value, or another number of elements.
std::optional<Field> fieldFor(const gl::BlockMember& member, const graph::UniformSpec& uniform);
// What a graph writes for the member: "a list of 2 numbers, for vec2".
std::string expectedFor(const gl::BlockMember& member);
// Writes the value, converted from double, to the field of a block; whether that changed it. Field::takes() must hold; `block` is
// the block's first byte. For integers a value is cut to a whole number in range, and NaN is 0.
bool writeValue(std::byte* block, const Field& field, const graph::Value& value);

// The names that the View block may declare (docs/shaders.md).
std::vector<std::string> viewMemberNames();
// Writes the members of `layout` that are view members. `viewport` (pixels) replaces the camera's. `timeless`: frame and
// times are 0, as for passes that are not `always`.
void writeView(std::byte* block, const gl::Block& layout, scene::ViewData view, glm::vec2 viewport,
               bool timeless);

}  // namespace weft::runtime
