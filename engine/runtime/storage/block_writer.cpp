#include "engine/runtime/storage/block_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <variant>

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

void putMatrix(std::byte* at, const gl::BlockMember& member, const glm::mat4& matrix) {
  const std::uint32_t stride = member.matrixStride ? member.matrixStride : 16;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) {
      const int major = member.rowMajor ? row : column, minor = member.rowMajor ? column : row;
      std::memcpy(at + static_cast<std::size_t>(major) * stride + static_cast<std::size_t>(minor) * 4,
                  &matrix[column][row], 4);
    }
}

using ViewField =
    std::variant<glm::mat4 scene::ViewData::*, glm::vec3 scene::ViewData::*, glm::vec2 scene::ViewData::*,
                 float scene::ViewData::*, std::uint32_t scene::ViewData::*>;
struct ViewMember {
  const char* name;
  ViewField field;
  bool time = false;
};
using V = scene::ViewData;
const ViewMember kViewMembers[] = {
    {"view", &V::view},
    {"projection", &V::projection},
    {"view_projection", &V::view_projection},
    {"inverse_view_projection", &V::inverse_view_projection},
    {"previous_view_projection", &V::previous_view_projection},
    {"eye", &V::eye},
    {"previous_eye", &V::previous_eye},
    {"near_plane", &V::near_plane},
    {"viewport", &V::viewport},
    {"jitter", &V::jitter},
    {"frame", &V::frame, true},
    {"time", &V::time, true},
    {"delta_time", &V::delta_time, true},
};

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
  for (const ViewMember& member : kViewMembers) names.emplace_back(member.name);
  return names;
}

void writeView(std::byte* block, const gl::Block& layout, const scene::ViewData& view, glm::vec2 viewport,
               bool timeless) {
  for (const gl::BlockMember& member : layout.members)
    for (const ViewMember& known : kViewMembers) {
      if (member.name != known.name) continue;
      std::byte* at = block + member.offset;
      if (known.time && timeless) {
        std::memset(at, 0, 4);
        continue;
      }
      std::visit(
          [&](auto field) {
            using T = std::remove_cvref_t<decltype(view.*field)>;
            if constexpr (std::is_same_v<T, glm::mat4>) {
              putMatrix(at, member, view.*field);
            } else {
              T value = view.*field;
              if constexpr (std::is_same_v<T, glm::vec2>)
                if (field == &V::viewport) value = viewport;
              std::memcpy(at, &value, sizeof value);
            }
          },
          known.field);
    }
}

}  // namespace weft::runtime
