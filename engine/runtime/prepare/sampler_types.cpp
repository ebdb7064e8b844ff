#include "engine/runtime/prepare/sampler_types.h"

namespace weft::runtime {

OpaqueType opaqueTypeOf(GLenum type) {
  switch (type) {
    case GL_SAMPLER_2D:
    case GL_IMAGE_2D:
      return {GL_TEXTURE_2D, GL_FLOAT};
    case GL_SAMPLER_2D_ARRAY:
    case GL_IMAGE_2D_ARRAY:
      return {GL_TEXTURE_2D_ARRAY, GL_FLOAT};
    case GL_SAMPLER_CUBE:
    case GL_IMAGE_CUBE:
      return {GL_TEXTURE_CUBE_MAP, GL_FLOAT};
    case GL_SAMPLER_CUBE_MAP_ARRAY:
    case GL_IMAGE_CUBE_MAP_ARRAY:
      return {GL_TEXTURE_CUBE_MAP_ARRAY, GL_FLOAT};
    case GL_SAMPLER_3D:
    case GL_IMAGE_3D:
      return {GL_TEXTURE_3D, GL_FLOAT};
    case GL_SAMPLER_2D_MULTISAMPLE:
    case GL_IMAGE_2D_MULTISAMPLE:
      return {GL_TEXTURE_2D_MULTISAMPLE, GL_FLOAT};
    case GL_SAMPLER_2D_SHADOW:
      return {GL_TEXTURE_2D, GL_FLOAT, true};
    case GL_SAMPLER_2D_ARRAY_SHADOW:
      return {GL_TEXTURE_2D_ARRAY, GL_FLOAT, true};
    case GL_SAMPLER_CUBE_SHADOW:
      return {GL_TEXTURE_CUBE_MAP, GL_FLOAT, true};
    case GL_SAMPLER_CUBE_MAP_ARRAY_SHADOW:
      return {GL_TEXTURE_CUBE_MAP_ARRAY, GL_FLOAT, true};
    case GL_INT_SAMPLER_2D:
    case GL_INT_IMAGE_2D:
      return {GL_TEXTURE_2D, GL_INT};
    case GL_INT_SAMPLER_2D_ARRAY:
    case GL_INT_IMAGE_2D_ARRAY:
      return {GL_TEXTURE_2D_ARRAY, GL_INT};
    case GL_INT_SAMPLER_CUBE:
    case GL_INT_IMAGE_CUBE:
      return {GL_TEXTURE_CUBE_MAP, GL_INT};
    case GL_INT_SAMPLER_3D:
    case GL_INT_IMAGE_3D:
      return {GL_TEXTURE_3D, GL_INT};
    case GL_UNSIGNED_INT_SAMPLER_2D:
    case GL_UNSIGNED_INT_IMAGE_2D:
      return {GL_TEXTURE_2D, GL_UNSIGNED_INT};
    case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY:
    case GL_UNSIGNED_INT_IMAGE_2D_ARRAY:
      return {GL_TEXTURE_2D_ARRAY, GL_UNSIGNED_INT};
    case GL_UNSIGNED_INT_SAMPLER_CUBE:
    case GL_UNSIGNED_INT_IMAGE_CUBE:
      return {GL_TEXTURE_CUBE_MAP, GL_UNSIGNED_INT};
    case GL_UNSIGNED_INT_SAMPLER_3D:
    case GL_UNSIGNED_INT_IMAGE_3D:
      return {GL_TEXTURE_3D, GL_UNSIGNED_INT};
    default:
      return {};
  }
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
