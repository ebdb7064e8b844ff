// GLSL types by their enums (OpenGL 4.5 core, table 7.3). Declared in program.h.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "engine/gl/context/debug.h"
#include "engine/gl/programs/program.h"

namespace weft::gl {

namespace {

// Of one to four components.
constexpr const char* kScalars[] = {"float", "int", "uint", "bool", "double"};
constexpr const char* kVectors[] = {"vec", "ivec", "uvec", "bvec", "dvec"};
constexpr GLenum kValues[][4] = {
    {GL_FLOAT, GL_FLOAT_VEC2, GL_FLOAT_VEC3, GL_FLOAT_VEC4},
    {GL_INT, GL_INT_VEC2, GL_INT_VEC3, GL_INT_VEC4},
    {GL_UNSIGNED_INT, GL_UNSIGNED_INT_VEC2, GL_UNSIGNED_INT_VEC3, GL_UNSIGNED_INT_VEC4},
    {GL_BOOL, GL_BOOL_VEC2, GL_BOOL_VEC3, GL_BOOL_VEC4},
    {GL_DOUBLE, GL_DOUBLE_VEC2, GL_DOUBLE_VEC3, GL_DOUBLE_VEC4}};

constexpr GLenum kMatrices[3][3] = {{GL_FLOAT_MAT2, GL_FLOAT_MAT2x3, GL_FLOAT_MAT2x4},
                                    {GL_FLOAT_MAT3x2, GL_FLOAT_MAT3, GL_FLOAT_MAT3x4},
                                    {GL_FLOAT_MAT4x2, GL_FLOAT_MAT4x3, GL_FLOAT_MAT4}};

// Of samplers and images of these shapes: their targets, and their types of float, int and uint.
constexpr const char* kShapes[] = {"2D", "2DArray", "Cube", "CubeArray", "3D", "2DMS"};
constexpr GLenum kTargets[] = {GL_TEXTURE_2D,       GL_TEXTURE_2D_ARRAY,
                               GL_TEXTURE_CUBE_MAP, GL_TEXTURE_CUBE_MAP_ARRAY,
                               GL_TEXTURE_3D,       GL_TEXTURE_2D_MULTISAMPLE};
constexpr GLenum kSamplers[][3] = {
    {GL_SAMPLER_2D, GL_INT_SAMPLER_2D, GL_UNSIGNED_INT_SAMPLER_2D},
    {GL_SAMPLER_2D_ARRAY, GL_INT_SAMPLER_2D_ARRAY, GL_UNSIGNED_INT_SAMPLER_2D_ARRAY},
    {GL_SAMPLER_CUBE, GL_INT_SAMPLER_CUBE, GL_UNSIGNED_INT_SAMPLER_CUBE},
    {GL_SAMPLER_CUBE_MAP_ARRAY, GL_INT_SAMPLER_CUBE_MAP_ARRAY, GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY},
    {GL_SAMPLER_3D, GL_INT_SAMPLER_3D, GL_UNSIGNED_INT_SAMPLER_3D},
    {GL_SAMPLER_2D_MULTISAMPLE, GL_INT_SAMPLER_2D_MULTISAMPLE, GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE}};
constexpr GLenum kImages[][3] = {
    {GL_IMAGE_2D, GL_INT_IMAGE_2D, GL_UNSIGNED_INT_IMAGE_2D},
    {GL_IMAGE_2D_ARRAY, GL_INT_IMAGE_2D_ARRAY, GL_UNSIGNED_INT_IMAGE_2D_ARRAY},
    {GL_IMAGE_CUBE, GL_INT_IMAGE_CUBE, GL_UNSIGNED_INT_IMAGE_CUBE},
    {GL_IMAGE_CUBE_MAP_ARRAY, GL_INT_IMAGE_CUBE_MAP_ARRAY, GL_UNSIGNED_INT_IMAGE_CUBE_MAP_ARRAY},
    {GL_IMAGE_3D, GL_INT_IMAGE_3D, GL_UNSIGNED_INT_IMAGE_3D},
    {GL_IMAGE_2D_MULTISAMPLE, GL_INT_IMAGE_2D_MULTISAMPLE, GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE}};
constexpr GLenum kShadows[] = {GL_SAMPLER_2D_SHADOW, GL_SAMPLER_2D_ARRAY_SHADOW, GL_SAMPLER_CUBE_SHADOW,
                               GL_SAMPLER_CUBE_MAP_ARRAY_SHADOW};

std::vector<GlslType> makeTypes() {
  std::vector<GlslType> types;
  for (std::size_t base = 0; base < std::size(kValues); ++base)
    for (std::uint32_t rows = 1; rows <= 4; ++rows)
      types.push_back({.type = kValues[base][rows - 1],
                       .name = rows == 1 ? kScalars[base] : kVectors[base] + std::to_string(rows),
                       .base = kValues[base][0],
                       .rows = rows});
  for (std::uint32_t columns = 2; columns <= 4; ++columns)
    for (std::uint32_t rows = 2; rows <= 4; ++rows)
      types.push_back(
          {.type = kMatrices[columns - 2][rows - 2],
           .name = "mat" + std::to_string(columns) + (rows == columns ? "" : "x" + std::to_string(rows)),
           .columns = columns,
           .rows = rows});
  const std::pair<std::string, GLenum> texels[] = {{"", GL_FLOAT}, {"i", GL_INT}, {"u", GL_UNSIGNED_INT}};
  for (std::size_t shape = 0; shape < std::size(kShapes); ++shape) {
    for (std::size_t i = 0; i < 3; ++i)
      for (const bool image : {false, true})
        types.push_back({.type = image ? kImages[shape][i] : kSamplers[shape][i],
                         .name = texels[i].first + (image ? "image" : "sampler") + kShapes[shape],
                         .kind = image ? GlslType::Kind::image : GlslType::Kind::sampler,
                         .base = texels[i].second,
                         .target = kTargets[shape]});
    if (shape < std::size(kShadows))
      types.push_back({.type = kShadows[shape],
                       .name = fmt::format("sampler{}Shadow", kShapes[shape]),
                       .kind = GlslType::Kind::sampler,
                       .target = kTargets[shape],
                       .shadow = true});
  }
  return types;
}

template <class Member, class Value>
const GlslType* findBy(Member member, const Value& value) {
  static const std::vector<GlslType> kTypes = makeTypes();
  const auto found = std::ranges::find(kTypes, value, member);
  return found == kTypes.end() ? nullptr : &*found;
}

}  // namespace

const GlslType* findGlslType(GLenum type) {
  return findBy(&GlslType::type, type);
}

const GlslType* findGlslType(std::string_view name) {
  return findBy(&GlslType::name, name);
}

std::string glslTypeName(GLenum type) {
  const GlslType* found = findGlslType(type);
  return found ? found->name : enumName(type);
}

const GlslType* shapeOf(GLenum type) {
  const GlslType* found = findGlslType(type);
  return found && found->kind == GlslType::Kind::value ? found : nullptr;
}

}  // namespace weft::gl
