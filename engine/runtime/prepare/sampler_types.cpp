#include "engine/runtime/prepare/sampler_types.h"

#include <utility>

namespace weft::runtime {

OpaqueType opaqueTypeOf(std::string_view name) {
  OpaqueType type;
  if (name.starts_with('u'))
    type.base = GL_UNSIGNED_INT;
  else if (name.starts_with("ii") || name.starts_with("is"))
    type.base = GL_INT;
  if (type.base != GL_FLOAT) name.remove_prefix(1);
  for (const std::string_view kind : {"sampler", "image"})
    if (name.starts_with(kind)) name.remove_prefix(kind.size());
  type.shadow = name.ends_with("Shadow");
  if (type.shadow) name.remove_suffix(std::string_view("Shadow").size());
  constexpr std::pair<std::string_view, GLenum> kTargets[] = {
      {"2D", GL_TEXTURE_2D},         {"2DArray", GL_TEXTURE_2D_ARRAY},
      {"Cube", GL_TEXTURE_CUBE_MAP}, {"CubeArray", GL_TEXTURE_CUBE_MAP_ARRAY},
      {"3D", GL_TEXTURE_3D},         {"2DMS", GL_TEXTURE_2D_MULTISAMPLE}};
  for (const auto& [shape, target] : kTargets)
    if (shape == name) type.target = target;
  return type;
}

std::string opaqueMismatch(const OpaqueType& type, const graph::FlatResource& resource,
                           const graph::FlatUse& use, bool compare) {
  using graph::Target;
  using graph::TexelKind;
  const bool cubes = resource.target == Target::texture_cube || resource.target == Target::texture_cube_array;
  const auto fitsTarget = [&] {
    switch (type.target) {
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
  const TexelKind kind = graph::infoOf(resource.format).kind;
  const bool stencil = use.planes == 2;
  const GLenum base = stencil || kind == TexelKind::unsigned_integer ? GL_UNSIGNED_INT
                      : kind == TexelKind::signed_integer            ? GL_INT
                                                                     : GL_FLOAT;
  if (type.base != base)
    return base == GL_FLOAT ? "a float type" : base == GL_INT ? "an int type" : "an unsigned int type";
  if (type.shadow && !compare) return "a type without Shadow (or say `as compare` in the slot)";
  if (!type.shadow && compare) return "a Shadow type (the slot says `as compare`)";
  return {};
}

}  // namespace weft::runtime
