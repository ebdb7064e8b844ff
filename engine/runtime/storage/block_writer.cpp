#include "engine/runtime/storage/block_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/imports/row_table.h"

namespace weft::runtime {

namespace {

// The nearest number that T has; 0 for NaN. (Out of range, C++ leaves the conversion undefined.)
template <class T>
T toWhole(double x) {
  if (std::isnan(x)) return 0;
  return static_cast<T>(std::clamp(x, static_cast<double>(std::numeric_limits<T>::min()),
                                   static_cast<double>(std::numeric_limits<T>::max())));
}

// Whether the bytes are others than before.
template <class T>
bool put(std::byte* at, T value) {
  if (std::memcmp(at, &value, sizeof value) == 0) return false;
  std::memcpy(at, &value, sizeof value);
  return true;
}

bool putScalar(std::byte* at, GLenum base, double x) {
  switch (base) {
    case GL_INT:
      return put(at, toWhole<std::int32_t>(x));
    case GL_UNSIGNED_INT:
      return put(at, toWhole<std::uint32_t>(x));
    case GL_BOOL:
      return put(at, std::uint32_t{x != 0});
    case GL_DOUBLE:
      return put(at, x);
    default:
      return put(at, static_cast<float>(x));
  }
}

// What the View block may declare.
const imports::Columns<scene::ViewData>& viewColumns() {
  using V = scene::ViewData;
  using imports::column;
  static const imports::Columns<V> kColumns = {
      column<V, &V::view>("view"),
      column<V, &V::projection>("projection"),
      column<V, &V::view_projection>("view_projection"),
      column<V, &V::inverse_view_projection>("inverse_view_projection"),
      column<V, &V::previous_view_projection>("previous_view_projection"),
      column<V, &V::eye>("eye"),
      column<V, &V::previous_eye>("previous_eye"),
      column<V, &V::near_plane>("near_plane"),
      column<V, &V::viewport>("viewport"),
      column<V, &V::jitter>("jitter"),
      column<V, &V::frame>("frame"),
      column<V, &V::time>("time"),
      column<V, &V::delta_time>("delta_time")};
  return kColumns;
}

}  // namespace

std::optional<Field> fieldFor(const gl::BlockMember& member, const graph::UniformSpec& uniform) {
  const auto shape = gl::shapeOf(member.type);
  const graph::Value& value = uniform.value;
  if (!shape) return std::nullopt;
  const bool matrix = shape->columns > 1, array = member.arraySize != 1 || member.arrayStride != 0;
  const std::uint32_t size = shape->base == GL_DOUBLE ? 8 : 4, element = uniform.element;
  Field field{member.offset, shape->base, shape->rows, size};
  if (element != graph::kNone) {
    const std::uint32_t elements = matrix ? shape->columns : member.arraySize;
    const bool known = elements != 0;  // the number may be one of the preprocessor's
    if (matrix == array || (known && elements != uniform.elements)) return std::nullopt;
    field.offset += element * (array ? member.arrayStride : member.rowMajor ? size : member.matrixStride);
    if (matrix && member.rowMajor) field.step = member.matrixStride;
  } else if (matrix) {
    return std::nullopt;
  } else if (array && value.type == graph::Value::Type::list && shape->rows == 1 &&
             (member.arraySize == 0 || member.arraySize == value.count)) {
    field.rows = value.count;
    field.step = member.arrayStride;
  } else if (member.arraySize != 1) {
    return std::nullopt;
  }
  return field.takes(value) ? std::optional(field) : std::nullopt;
}

std::string expectedFor(const gl::BlockMember& member) {
  const auto shape = gl::shapeOf(member.type);
  std::string type = gl::glslTypeName(member.type);
  const bool array = member.arraySize != 1 || member.arrayStride != 0, matrix = shape && shape->columns > 1;
  if (array) type += fmt::format("[{}]", member.arraySize);
  if (!shape || (array && matrix))
    return "a scalar, a vector, a matrix or an array of vectors in the shader, not " + type;
  const std::string of = shape->rows == 1 ? "" : fmt::format(" of {} numbers", shape->rows);
  if (!array && !matrix)
    return of.empty() ? fmt::format("a number, for {}", type) : fmt::format("a list{}, for {}", of, type);
  return fmt::format("a list of {} {}{}{}, for {}", matrix ? shape->columns : member.arraySize,
                     of.empty() ? "numbers" : "lists", of, matrix ? ", its columns" : "", type);
}

bool writeValue(std::byte* block, const Field& field, const graph::Value& value) {
  bool changed = false;
  for (std::uint32_t i = 0; i < field.rows; ++i)
    changed |= putScalar(block + field.offset + std::size_t{i} * field.step, field.base, value.v[i]);
  return changed;
}

std::vector<std::string> viewMemberNames() {
  std::vector<std::string> names;
  for (const auto& column : viewColumns()) names.push_back(column.told.name);
  return names;
}

void writeView(std::byte* block, const gl::Block& layout, scene::ViewData view, glm::vec2 viewport,
               bool timeless) {
  view.viewport = viewport;
  if (timeless) view.time = view.delta_time = 0, view.frame = 0;
  for (const gl::BlockMember& member : layout.members)
    for (const auto& column : viewColumns()) {
      if (member.name != column.told.name) continue;
      std::byte* const at = block + member.offset;
      column.write({&view, 1}, at, 0);
      if (!member.rowMajor || member.matrixStride == 0) continue;
      glm::mat4 matrix;
      std::memcpy(&matrix, at, sizeof matrix);
      matrix = glm::transpose(matrix);
      std::memcpy(at, &matrix, sizeof matrix);
    }
}

}  // namespace weft::runtime
