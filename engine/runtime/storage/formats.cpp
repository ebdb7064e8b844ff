#include "engine/runtime/storage/formats.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace weft::runtime {

namespace {

using graph::Format;

// In the order of Format.
// clang-format off
constexpr GLenum kFormats[] = {
    GL_NONE, GL_R8, GL_RG8, GL_RGBA8, GL_SRGB8_ALPHA8, GL_R8_SNORM, GL_RG8_SNORM, GL_RGBA8_SNORM,
    GL_R16, GL_RG16, GL_RGBA16, GL_R16F, GL_RG16F, GL_RGBA16F, GL_R32F, GL_RG32F, GL_RGBA32F,
    GL_R11F_G11F_B10F, GL_RGB10_A2, GL_RGB9_E5, GL_R8UI, GL_R16UI, GL_R32UI, GL_RG16UI, GL_RG32UI, GL_RGBA8UI,
    GL_RGBA16UI, GL_RGBA32UI, GL_R32I, GL_RG32I, GL_RGBA32I, GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24,
    GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8, GL_DEPTH32F_STENCIL8};
// clang-format on
static_assert(std::size(kFormats) == static_cast<std::size_t>(Format::count_));

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
  return kFormats[static_cast<std::size_t>(format)];
}

GLenum glTargetOf(graph::Target target) {
  static constexpr GLenum kTargets[] = {GL_TEXTURE_2D,       GL_TEXTURE_2D_ARRAY,
                                        GL_TEXTURE_CUBE_MAP, GL_TEXTURE_CUBE_MAP_ARRAY,
                                        GL_TEXTURE_3D,       GL_TEXTURE_2D_MULTISAMPLE};
  return kTargets[static_cast<std::size_t>(target)];
}

GLbitfield glBarriersOf(std::uint16_t barriers) {
  // In the order of BarrierBit.
  static constexpr GLbitfield kBits[] = {
      GL_UNIFORM_BARRIER_BIT,     GL_TEXTURE_FETCH_BARRIER_BIT,  GL_SHADER_IMAGE_ACCESS_BARRIER_BIT,
      GL_COMMAND_BARRIER_BIT,     GL_TEXTURE_UPDATE_BARRIER_BIT, GL_BUFFER_UPDATE_BARRIER_BIT,
      GL_FRAMEBUFFER_BARRIER_BIT, GL_SHADER_STORAGE_BARRIER_BIT};
  GLbitfield bits = 0;
  for (int i = 0; i < graph::kBarrierBitCount; ++i)
    if ((barriers >> i & 1) != 0) bits |= kBits[i];
  return bits;
}

GLenum glCompareOf(graph::Compare compare) {
  static constexpr GLenum kFunctions[] = {GL_NEVER,   GL_LESS,     GL_EQUAL,  GL_LEQUAL,
                                          GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
  return kFunctions[static_cast<std::size_t>(compare)];
}

ExactTexel exactTexelOf(Format format) {
  const GLenum own = glFormatOf(format);
  switch (format) {  // depth has no views of another format
    case Format::depth16:
      return {own, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT};
    case Format::depth24:  // depth-is-rounded-down, gl/context/workarounds.md
    case Format::depth32f:
      return {own, GL_DEPTH_COMPONENT, GL_FLOAT};
    case Format::depth24_stencil8:
      return {own, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8};
    case Format::depth32f_stencil8:
      return {own, GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV};
    default:
      break;
  }
  switch (graph::infoOf(format).bytes) {
    case 1:
      return {GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE};
    case 2:
      return {GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT};
    case 4:
      return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT};
    case 8:
      return {GL_RG32UI, GL_RG_INTEGER, GL_UNSIGNED_INT};
    default:
      return {GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT};
  }
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
