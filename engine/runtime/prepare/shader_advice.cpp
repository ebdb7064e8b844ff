#include "engine/runtime/prepare/shader_advice.h"

#include <fmt/format.h>

namespace weft::runtime {

namespace {

using graph::FlatResource;
using graph::FlatUse;
using graph::Kind;
using graph::Target;
using graph::TexelKind;

// The prefix of "sampler2D" and "vec4": "", "u" or "i".
const char* prefixFor(const FlatUse& use, const FlatResource& resource) {
  const TexelKind kind = graph::infoOf(resource.format).kind;
  if (use.planes == 2 || kind == TexelKind::unsigned_integer) return "u";
  return kind == TexelKind::signed_integer ? "i" : "";
}

std::string shapeFor(const FlatUse& use, const FlatResource& resource) {
  if (resource.samples > 1) return "2DMS";
  if (resource.target == Target::texture_3d) return "3D";
  const bool cubes = resource.target == Target::texture_cube || resource.target == Target::texture_cube_array;
  if (cubes && use.layers % 6 == 0 && use.layer % 6 == 0) return use.layers == 6 ? "Cube" : "CubeArray";
  return use.layers > 1 ? "2DArray" : "2D";
}

}  // namespace

std::string declarationFor(const graph::SlotSpec& slot, Kind kind, const FlatUse& use,
                           const FlatResource& resource) {
  const std::string count = slot.array ? fmt::format("[{}]", slot.useCount) : "";
  const char* const qualifier = slot.access == graph::Access::read    ? "readonly "
                                : slot.access == graph::Access::write ? "writeonly "
                                                                      : "";
  switch (kind) {
    case Kind::sampled:
      return fmt::format("uniform {}sampler{}{} {}{};", prefixFor(use, resource), shapeFor(use, resource),
                         slot.sampler.compare ? "Shadow" : "", slot.name, count);
    case Kind::image:
      return fmt::format("layout({}) uniform {}{}image{} {}{};", graph::infoOf(resource.format).name,
                         qualifier, prefixFor(use, resource), shapeFor(use, resource), slot.name, count);
    case Kind::storage:
      return fmt::format("layout(std430) {}buffer {} {{ … }};", qualifier, slot.name);
    case Kind::uniform:
      return fmt::format("layout(std140) uniform {} {{ … }};", slot.name);
    case Kind::color:
      return fmt::format("out {}vec4 {};", prefixFor(use, resource), slot.name);
    default:
      return {};
  }
}

std::string memberTypeFor(const graph::Value& value) {
  switch (value.type) {
    case graph::Value::Type::boolean:
      return "bool";
    case graph::Value::Type::list:
      return fmt::format("vec{}", value.count);
    default:
      return "float";
  }
}

}  // namespace weft::runtime
