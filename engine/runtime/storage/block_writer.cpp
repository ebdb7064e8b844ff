#include "engine/runtime/storage/block_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
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

void putScalar(std::byte* at, GLenum base, double x) {
  if (base == GL_INT) {
    const auto value = toWhole<std::int32_t>(x);
    std::memcpy(at, &value, sizeof value);
  } else if (base == GL_UNSIGNED_INT) {
    const auto value = toWhole<std::uint32_t>(x);
    std::memcpy(at, &value, sizeof value);
  } else if (base == GL_BOOL) {
    const std::uint32_t value = x != 0;
    std::memcpy(at, &value, sizeof value);
  } else if (base == GL_DOUBLE) {
    std::memcpy(at, &x, sizeof x);
  } else {
    const auto value = static_cast<float>(x);
    std::memcpy(at, &value, sizeof value);
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

bool memberTakes(const gl::BlockMember& member, const graph::Value& value, std::string& expected) {
  const auto shape = gl::shapeOf(member.type);
  if (!shape || shape->columns != 1 || member.arraySize != 1) {
    expected = "a scalar or vector member in the shader, not " + gl::glslTypeName(member.type);
    if (member.arraySize != 1) expected += fmt::format("[{}]", member.arraySize);
    return false;
  }
  const bool list = value.type == graph::Value::Type::list;
  const bool fits = value.type != graph::Value::Type::symbol && value.type != graph::Value::Type::none &&
                    (list ? value.count == shape->rows : shape->rows == 1);
  if (!fits)
    expected = shape->rows == 1
                   ? "a number, for " + gl::glslTypeName(member.type)
                   : fmt::format("a list of {} numbers, for {}", shape->rows, gl::glslTypeName(member.type));
  return fits;
}

void writeValue(std::byte* block, const gl::BlockMember& member, const graph::Value& value) {
  const auto shape = gl::shapeOf(member.type);
  assert(shape);
  const std::size_t size = shape->base == GL_DOUBLE ? 8 : 4;
  for (std::uint32_t i = 0; i < shape->rows; ++i)
    putScalar(block + member.offset + i * size, shape->base, value.v[i]);
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
