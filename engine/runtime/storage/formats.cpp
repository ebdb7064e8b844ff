#include "engine/runtime/storage/formats.h"

#include <algorithm>
#include <cstring>

namespace weft::runtime {

namespace {

using graph::Format;

constexpr std::pair<Format, GLenum> kFormats[] = {{Format::r8, GL_R8},
                                                  {Format::rg8, GL_RG8},
                                                  {Format::rgba8, GL_RGBA8},
                                                  {Format::srgb8_a8, GL_SRGB8_ALPHA8},
                                                  {Format::r8_snorm, GL_R8_SNORM},
                                                  {Format::rg8_snorm, GL_RG8_SNORM},
                                                  {Format::rgba8_snorm, GL_RGBA8_SNORM},
                                                  {Format::r16, GL_R16},
                                                  {Format::rg16, GL_RG16},
                                                  {Format::rgba16, GL_RGBA16},
                                                  {Format::r16f, GL_R16F},
                                                  {Format::rg16f, GL_RG16F},
                                                  {Format::rgba16f, GL_RGBA16F},
                                                  {Format::r32f, GL_R32F},
                                                  {Format::rg32f, GL_RG32F},
                                                  {Format::rgba32f, GL_RGBA32F},
                                                  {Format::r11f_g11f_b10f, GL_R11F_G11F_B10F},
                                                  {Format::rgb10_a2, GL_RGB10_A2},
                                                  {Format::rgb9_e5, GL_RGB9_E5},
                                                  {Format::r8ui, GL_R8UI},
                                                  {Format::r16ui, GL_R16UI},
                                                  {Format::r32ui, GL_R32UI},
                                                  {Format::rg16ui, GL_RG16UI},
                                                  {Format::rg32ui, GL_RG32UI},
                                                  {Format::rgba8ui, GL_RGBA8UI},
                                                  {Format::rgba16ui, GL_RGBA16UI},
                                                  {Format::rgba32ui, GL_RGBA32UI},
                                                  {Format::r32i, GL_R32I},
                                                  {Format::rg32i, GL_RG32I},
                                                  {Format::rgba32i, GL_RGBA32I},
                                                  {Format::depth16, GL_DEPTH_COMPONENT16},
                                                  {Format::depth24, GL_DEPTH_COMPONENT24},
                                                  {Format::depth32f, GL_DEPTH_COMPONENT32F},
                                                  {Format::depth24_stencil8, GL_DEPTH24_STENCIL8},
                                                  {Format::depth32f_stencil8, GL_DEPTH32F_STENCIL8}};

template <class T>
ClearTexel texelOf(GLenum format, GLenum type, const T& data) {
  static_assert(sizeof(T) <= 16);
  ClearTexel texel{format, type, {}};
  std::memcpy(texel.bytes.data(), &data, sizeof data);
  return texel;
}

std::array<double, 4> channels(const graph::Value& value) {
  if (value.type == graph::Value::Type::list) return value.v;
  return {value.v[0], value.v[0], value.v[0], value.v[0]};
}

}  // namespace

GLenum glFormatOf(Format format) {
  const auto found = std::ranges::find(kFormats, format, &std::pair<Format, GLenum>::first);
  return found == std::end(kFormats) ? GL_NONE : found->second;
}

GLenum glTargetOf(graph::Target target) {
  static constexpr GLenum kTargets[] = {GL_TEXTURE_2D,       GL_TEXTURE_2D_ARRAY,
                                        GL_TEXTURE_CUBE_MAP, GL_TEXTURE_CUBE_MAP_ARRAY,
                                        GL_TEXTURE_3D,       GL_TEXTURE_2D_MULTISAMPLE};
  return kTargets[static_cast<std::size_t>(target)];
}

GLbitfield glBarriersOf(std::uint16_t barriers) {
  static constexpr std::pair<graph::BarrierBit, GLbitfield> kBits[] = {
      {graph::kBarrierVertex, GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT},
      {graph::kBarrierIndex, GL_ELEMENT_ARRAY_BARRIER_BIT},
      {graph::kBarrierUniform, GL_UNIFORM_BARRIER_BIT},
      {graph::kBarrierTexture, GL_TEXTURE_FETCH_BARRIER_BIT},
      {graph::kBarrierImage, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT},
      {graph::kBarrierCommand, GL_COMMAND_BARRIER_BIT},
      {graph::kBarrierTextureUpdate, GL_TEXTURE_UPDATE_BARRIER_BIT},
      {graph::kBarrierBufferUpdate, GL_BUFFER_UPDATE_BARRIER_BIT},
      {graph::kBarrierFramebuffer, GL_FRAMEBUFFER_BARRIER_BIT},
      {graph::kBarrierStorage, GL_SHADER_STORAGE_BARRIER_BIT},
  };
  GLbitfield bits = 0;
  for (const auto& [mine, gl] : kBits)
    if (barriers & mine) bits |= gl;
  return bits;
}

GLenum glCompareOf(graph::Compare compare) {
  static constexpr GLenum kFunctions[] = {GL_NEVER,   GL_LESS,     GL_EQUAL,  GL_LEQUAL,
                                          GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
  return kFunctions[static_cast<std::size_t>(compare)];
}

std::array<float, 4> clearChannelsOf(const graph::Value& value) {
  const auto v = channels(value);
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]),
          static_cast<float>(v[3])};
}

ClearTexel clearTexelOf(Format format, const graph::Value& value) {
  const std::array<double, 4> v = channels(value);
  switch (graph::infoOf(format).kind) {
    case graph::TexelKind::depth:
      return texelOf(GL_DEPTH_COMPONENT, GL_FLOAT, static_cast<float>(v[0]));
    case graph::TexelKind::depth_stencil: {
      const bool list = value.type == graph::Value::Type::list;
      const struct {
        float depth;
        std::uint32_t stencil;
      } pair = {static_cast<float>(v[0]),
                list ? static_cast<std::uint32_t>(std::clamp(v[1], 0.0, 255.0)) : 0u};
      return texelOf(GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, pair);
    }
    case graph::TexelKind::unsigned_integer: {
      std::array<std::uint32_t, 4> texel{};
      for (std::size_t i = 0; i < 4; ++i)
        texel[i] = static_cast<std::uint32_t>(std::clamp(v[i], 0.0, 4294967295.0));
      return texelOf(GL_RGBA_INTEGER, GL_UNSIGNED_INT, texel);
    }
    case graph::TexelKind::signed_integer: {
      std::array<std::int32_t, 4> texel{};
      for (std::size_t i = 0; i < 4; ++i)
        texel[i] = static_cast<std::int32_t>(std::clamp(v[i], -2147483648.0, 2147483647.0));
      return texelOf(GL_RGBA_INTEGER, GL_INT, texel);
    }
    default:
      return texelOf(GL_RGBA, GL_FLOAT, clearChannelsOf(value));
  }
}

}  // namespace weft::runtime
