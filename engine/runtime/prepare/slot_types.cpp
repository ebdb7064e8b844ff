#include "engine/runtime/prepare/slot_types.h"

#include <fmt/format.h>

namespace weft::runtime {

using graph::FlatResource;
using graph::FlatUse;
using graph::Kind;
using graph::Target;
using graph::TexelKind;

namespace {

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

std::string opaqueMismatch(const gl::GlslType* type, const FlatResource& resource, const FlatUse& use,
                           bool compare) {
  const bool cubes = resource.target == Target::texture_cube || resource.target == Target::texture_cube_array;
  const auto fitsTarget = [&] {
    switch (type ? type->target : 0) {
      case GL_TEXTURE_2D:
        return resource.target != Target::texture_3d && use.layers == 1 && resource.samples == 1;
      case GL_TEXTURE_2D_ARRAY:
        return resource.target != Target::texture_3d && resource.samples == 1;
      case GL_TEXTURE_CUBE_MAP:
        return cubes && use.layers == 6 && use.layer % 6 == 0;
      case GL_TEXTURE_CUBE_MAP_ARRAY:
        return cubes && use.layers % 6 == 0 && use.layer % 6 == 0;
      case GL_TEXTURE_3D:
        return resource.target == Target::texture_3d;
      case GL_TEXTURE_2D_MULTISAMPLE:
        return resource.samples > 1;
      default:
        return false;
    }
  };
  if (!fitsTarget()) {
    if (resource.samples > 1) return "a 2DMS type";
    if (resource.target == Target::texture_3d) return "a 3D type";
    if (use.layers == 1) return "a 2D type";
    if (cubes && use.layers % 6 == 0)
      return use.layers == 6 ? "a Cube or 2DArray type" : "a CubeArray or 2DArray type";
    return "a 2DArray type";
  }
  const std::string_view prefix = prefixFor(use, resource);
  const GLenum base = prefix == "u" ? GL_UNSIGNED_INT : prefix == "i" ? GL_INT : GL_FLOAT;
  if (type->base != base)
    return base == GL_FLOAT ? "a float type" : base == GL_INT ? "an int type" : "an unsigned int type";
  if (type->shadow && !compare) return "a type without Shadow (or say `as compare` in the slot)";
  if (!type->shadow && compare) return "a Shadow type (the slot says `as compare`)";
  return {};
}

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
