// GLSL types by their enums (OpenGL 4.5 core, table 7.3).
#include "engine/gl/programs/glsl_type.h"

#include <algorithm>

#include "engine/gl/context/debug.h"

namespace weft::gl {

namespace {

constexpr GlslType kTypes[] = {
    {GL_FLOAT, "float", GlslKind::value, {GL_FLOAT, 1, 1}},
    {GL_FLOAT_VEC2, "vec2", GlslKind::value, {GL_FLOAT, 1, 2}},
    {GL_FLOAT_VEC3, "vec3", GlslKind::value, {GL_FLOAT, 1, 3}},
    {GL_FLOAT_VEC4, "vec4", GlslKind::value, {GL_FLOAT, 1, 4}},
    {GL_INT, "int", GlslKind::value, {GL_INT, 1, 1}},
    {GL_INT_VEC2, "ivec2", GlslKind::value, {GL_INT, 1, 2}},
    {GL_INT_VEC3, "ivec3", GlslKind::value, {GL_INT, 1, 3}},
    {GL_INT_VEC4, "ivec4", GlslKind::value, {GL_INT, 1, 4}},
    {GL_UNSIGNED_INT, "uint", GlslKind::value, {GL_UNSIGNED_INT, 1, 1}},
    {GL_UNSIGNED_INT_VEC2, "uvec2", GlslKind::value, {GL_UNSIGNED_INT, 1, 2}},
    {GL_UNSIGNED_INT_VEC3, "uvec3", GlslKind::value, {GL_UNSIGNED_INT, 1, 3}},
    {GL_UNSIGNED_INT_VEC4, "uvec4", GlslKind::value, {GL_UNSIGNED_INT, 1, 4}},
    {GL_BOOL, "bool", GlslKind::value, {GL_BOOL, 1, 1}},
    {GL_BOOL_VEC2, "bvec2", GlslKind::value, {GL_BOOL, 1, 2}},
    {GL_BOOL_VEC3, "bvec3", GlslKind::value, {GL_BOOL, 1, 3}},
    {GL_BOOL_VEC4, "bvec4", GlslKind::value, {GL_BOOL, 1, 4}},
    {GL_DOUBLE, "double", GlslKind::value, {GL_DOUBLE, 1, 1}},
    {GL_DOUBLE_VEC2, "dvec2", GlslKind::value, {GL_DOUBLE, 1, 2}},
    {GL_DOUBLE_VEC3, "dvec3", GlslKind::value, {GL_DOUBLE, 1, 3}},
    {GL_DOUBLE_VEC4, "dvec4", GlslKind::value, {GL_DOUBLE, 1, 4}},
    {GL_FLOAT_MAT2, "mat2", GlslKind::value, {GL_FLOAT, 2, 2}},
    {GL_FLOAT_MAT2x3, "mat2x3", GlslKind::value, {GL_FLOAT, 2, 3}},
    {GL_FLOAT_MAT2x4, "mat2x4", GlslKind::value, {GL_FLOAT, 2, 4}},
    {GL_FLOAT_MAT3x2, "mat3x2", GlslKind::value, {GL_FLOAT, 3, 2}},
    {GL_FLOAT_MAT3, "mat3", GlslKind::value, {GL_FLOAT, 3, 3}},
    {GL_FLOAT_MAT3x4, "mat3x4", GlslKind::value, {GL_FLOAT, 3, 4}},
    {GL_FLOAT_MAT4x2, "mat4x2", GlslKind::value, {GL_FLOAT, 4, 2}},
    {GL_FLOAT_MAT4x3, "mat4x3", GlslKind::value, {GL_FLOAT, 4, 3}},
    {GL_FLOAT_MAT4, "mat4", GlslKind::value, {GL_FLOAT, 4, 4}},
    {GL_SAMPLER_1D, "sampler1D", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_1D, "isampler1D", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_1D, "usampler1D", GlslKind::sampler, {}},
    {GL_SAMPLER_2D, "sampler2D", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_2D, "isampler2D", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_2D, "usampler2D", GlslKind::sampler, {}},
    {GL_SAMPLER_3D, "sampler3D", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_3D, "isampler3D", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_3D, "usampler3D", GlslKind::sampler, {}},
    {GL_SAMPLER_CUBE, "samplerCube", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_CUBE, "isamplerCube", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_CUBE, "usamplerCube", GlslKind::sampler, {}},
    {GL_SAMPLER_2D_RECT, "sampler2DRect", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_2D_RECT, "isampler2DRect", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_2D_RECT, "usampler2DRect", GlslKind::sampler, {}},
    {GL_SAMPLER_1D_ARRAY, "sampler1DArray", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_1D_ARRAY, "isampler1DArray", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_1D_ARRAY, "usampler1DArray", GlslKind::sampler, {}},
    {GL_SAMPLER_2D_ARRAY, "sampler2DArray", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_2D_ARRAY, "isampler2DArray", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_2D_ARRAY, "usampler2DArray", GlslKind::sampler, {}},
    {GL_SAMPLER_CUBE_MAP_ARRAY, "samplerCubeArray", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_CUBE_MAP_ARRAY, "isamplerCubeArray", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY, "usamplerCubeArray", GlslKind::sampler, {}},
    {GL_SAMPLER_BUFFER, "samplerBuffer", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_BUFFER, "isamplerBuffer", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_BUFFER, "usamplerBuffer", GlslKind::sampler, {}},
    {GL_SAMPLER_2D_MULTISAMPLE, "sampler2DMS", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_2D_MULTISAMPLE, "isampler2DMS", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE, "usampler2DMS", GlslKind::sampler, {}},
    {GL_SAMPLER_2D_MULTISAMPLE_ARRAY, "sampler2DMSArray", GlslKind::sampler, {}},
    {GL_INT_SAMPLER_2D_MULTISAMPLE_ARRAY, "isampler2DMSArray", GlslKind::sampler, {}},
    {GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE_ARRAY, "usampler2DMSArray", GlslKind::sampler, {}},
    {GL_SAMPLER_1D_SHADOW, "sampler1DShadow", GlslKind::sampler, {}},
    {GL_SAMPLER_2D_SHADOW, "sampler2DShadow", GlslKind::sampler, {}},
    {GL_SAMPLER_CUBE_SHADOW, "samplerCubeShadow", GlslKind::sampler, {}},
    {GL_SAMPLER_2D_RECT_SHADOW, "sampler2DRectShadow", GlslKind::sampler, {}},
    {GL_SAMPLER_1D_ARRAY_SHADOW, "sampler1DArrayShadow", GlslKind::sampler, {}},
    {GL_SAMPLER_2D_ARRAY_SHADOW, "sampler2DArrayShadow", GlslKind::sampler, {}},
    {GL_SAMPLER_CUBE_MAP_ARRAY_SHADOW, "samplerCubeArrayShadow", GlslKind::sampler, {}},
    {GL_IMAGE_1D, "image1D", GlslKind::image, {}},
    {GL_INT_IMAGE_1D, "iimage1D", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_1D, "uimage1D", GlslKind::image, {}},
    {GL_IMAGE_2D, "image2D", GlslKind::image, {}},
    {GL_INT_IMAGE_2D, "iimage2D", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_2D, "uimage2D", GlslKind::image, {}},
    {GL_IMAGE_3D, "image3D", GlslKind::image, {}},
    {GL_INT_IMAGE_3D, "iimage3D", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_3D, "uimage3D", GlslKind::image, {}},
    {GL_IMAGE_CUBE, "imageCube", GlslKind::image, {}},
    {GL_INT_IMAGE_CUBE, "iimageCube", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_CUBE, "uimageCube", GlslKind::image, {}},
    {GL_IMAGE_2D_RECT, "image2DRect", GlslKind::image, {}},
    {GL_INT_IMAGE_2D_RECT, "iimage2DRect", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_2D_RECT, "uimage2DRect", GlslKind::image, {}},
    {GL_IMAGE_1D_ARRAY, "image1DArray", GlslKind::image, {}},
    {GL_INT_IMAGE_1D_ARRAY, "iimage1DArray", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_1D_ARRAY, "uimage1DArray", GlslKind::image, {}},
    {GL_IMAGE_2D_ARRAY, "image2DArray", GlslKind::image, {}},
    {GL_INT_IMAGE_2D_ARRAY, "iimage2DArray", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_2D_ARRAY, "uimage2DArray", GlslKind::image, {}},
    {GL_IMAGE_CUBE_MAP_ARRAY, "imageCubeArray", GlslKind::image, {}},
    {GL_INT_IMAGE_CUBE_MAP_ARRAY, "iimageCubeArray", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_CUBE_MAP_ARRAY, "uimageCubeArray", GlslKind::image, {}},
    {GL_IMAGE_BUFFER, "imageBuffer", GlslKind::image, {}},
    {GL_INT_IMAGE_BUFFER, "iimageBuffer", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_BUFFER, "uimageBuffer", GlslKind::image, {}},
    {GL_IMAGE_2D_MULTISAMPLE, "image2DMS", GlslKind::image, {}},
    {GL_INT_IMAGE_2D_MULTISAMPLE, "iimage2DMS", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE, "uimage2DMS", GlslKind::image, {}},
    {GL_IMAGE_2D_MULTISAMPLE_ARRAY, "image2DMSArray", GlslKind::image, {}},
    {GL_INT_IMAGE_2D_MULTISAMPLE_ARRAY, "iimage2DMSArray", GlslKind::image, {}},
    {GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY, "uimage2DMSArray", GlslKind::image, {}},
};

}  // namespace

const GlslType* findGlslType(GLenum type) {
  const auto found =
      std::find_if(std::begin(kTypes), std::end(kTypes), [&](const GlslType& t) { return t.type == type; });
  return found == std::end(kTypes) ? nullptr : found;
}

const GlslType* findGlslType(std::string_view name) {
  const auto found =
      std::find_if(std::begin(kTypes), std::end(kTypes), [&](const GlslType& t) { return t.name == name; });
  return found == std::end(kTypes) ? nullptr : found;
}

std::string glslTypeName(GLenum type) {
  const GlslType* found = findGlslType(type);
  return found ? found->name : enumName(type);
}

std::optional<TypeShape> shapeOf(GLenum type) {
  const GlslType* found = findGlslType(type);
  if (!found || found->kind != GlslKind::value) return std::nullopt;
  return found->shape;
}

}  // namespace weft::gl
