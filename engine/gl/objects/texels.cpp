// Synchronous uploads and read-backs, and the sizes and classes they need.
#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "engine/gl/objects/objects.h"

namespace weft::gl {

namespace {

GLint toInt(std::uint32_t value) {
  return static_cast<GLint>(value);
}

GLsizei byteCount(const Extent& extent, GLenum format, GLenum type) {
  const std::uint64_t bytes = std::uint64_t{extent.width} * extent.height * texelBytes(format, type);
  assert(bytes <= 0x7fffffff);
  return static_cast<GLsizei>(bytes);
}

void getLayer(const TextureRef& texture, std::uint32_t mip, std::uint32_t layer, GLenum format, GLenum type,
              GLsizei bytes, void* where) {
  const Extent extent = extentOf(texture.desc, mip);
  assert(mip < texture.desc.mips && layer < extent.layers && texture.desc.samples == 1);
  glGetTextureSubImage(texture.id, toInt(mip), 0, 0, toInt(layer), toInt(extent.width), toInt(extent.height),
                       1, format, type, bytes, where);
}

}  // namespace

Extent extentOf(const TextureDesc& desc, std::uint32_t mip) {
  Extent extent{std::max(1u, desc.width >> mip), std::max(1u, desc.height >> mip), desc.layers};
  if (desc.target == GL_TEXTURE_3D) extent.layers = std::max(1u, desc.depth >> mip);
  return extent;
}

std::uint32_t texelBytes(GLenum format, GLenum type) {
  switch (type) {
    case GL_UNSIGNED_INT_2_10_10_10_REV:
    case GL_UNSIGNED_INT_10F_11F_11F_REV:
    case GL_UNSIGNED_INT_5_9_9_9_REV:
    case GL_UNSIGNED_INT_24_8:
      return 4;
    case GL_FLOAT_32_UNSIGNED_INT_24_8_REV:
      return 8;
    default:
      break;
  }
  std::uint32_t channels = 1;
  switch (format) {
    case GL_RG:
    case GL_RG_INTEGER:
      channels = 2;
      break;
    case GL_RGB:
    case GL_RGB_INTEGER:
      channels = 3;
      break;
    case GL_RGBA:
    case GL_BGRA:
    case GL_RGBA_INTEGER:
      channels = 4;
      break;
    default:
      break;
  }
  switch (type) {
    case GL_UNSIGNED_BYTE:
    case GL_BYTE:
      return channels;
    case GL_UNSIGNED_SHORT:
    case GL_SHORT:
    case GL_HALF_FLOAT:
      return channels * 2;
    default:
      return channels * 4;
  }
}

FormatClass classOf(GLenum internalFormat) {
  switch (internalFormat) {
    case GL_R8UI:
    case GL_RG8UI:
    case GL_RGB8UI:
    case GL_RGBA8UI:
    case GL_R16UI:
    case GL_RG16UI:
    case GL_RGB16UI:
    case GL_RGBA16UI:
    case GL_R32UI:
    case GL_RG32UI:
    case GL_RGB32UI:
    case GL_RGBA32UI:
    case GL_RGB10_A2UI:
      return FormatClass::unsigned_integer;
    case GL_R8I:
    case GL_RG8I:
    case GL_RGB8I:
    case GL_RGBA8I:
    case GL_R16I:
    case GL_RG16I:
    case GL_RGB16I:
    case GL_RGBA16I:
    case GL_R32I:
    case GL_RG32I:
    case GL_RGB32I:
    case GL_RGBA32I:
      return FormatClass::signed_integer;
    case GL_DEPTH_COMPONENT16:
    case GL_DEPTH_COMPONENT24:
    case GL_DEPTH_COMPONENT32:
    case GL_DEPTH_COMPONENT32F:
      return FormatClass::depth;
    case GL_DEPTH24_STENCIL8:
    case GL_DEPTH32F_STENCIL8:
      return FormatClass::depth_stencil;
    default:
      return FormatClass::floating;
  }
}

std::uint32_t floatChannelsOf(GLenum internalFormat) {
  const FormatClass kind = classOf(internalFormat);
  return kind == FormatClass::depth || kind == FormatClass::depth_stencil ? 1 : 4;
}

void uploadTexture(const TextureRef& texture, std::uint32_t mip, std::uint32_t layer, GLenum format,
                   GLenum type, std::span<const std::byte> data) {
  const Extent extent = extentOf(texture.desc, mip);
  assert(mip < texture.desc.mips && layer < extent.layers && texture.desc.samples == 1);
  assert(data.size() == static_cast<std::size_t>(byteCount(extent, format, type)));
  const GLsizei width = toInt(extent.width), height = toInt(extent.height);
  if (texture.desc.target == GL_TEXTURE_2D)
    glTextureSubImage2D(texture.id, toInt(mip), 0, 0, width, height, format, type, data.data());
  else
    glTextureSubImage3D(texture.id, toInt(mip), 0, 0, toInt(layer), width, height, 1, format, type,
                        data.data());
}

std::vector<std::byte> readTexture(const TextureRef& texture, std::uint32_t mip, std::uint32_t layer,
                                   GLenum format, GLenum type) {
  const GLsizei bytes = byteCount(extentOf(texture.desc, mip), format, type);
  std::vector<std::byte> data(static_cast<std::size_t>(bytes));
  getLayer(texture, mip, layer, format, type, bytes, data.data());
  return data;
}

std::vector<float> readFloats(const TextureRef& texture, std::uint32_t mip, std::uint32_t layer) {
  const Extent extent = extentOf(texture.desc, mip);
  std::vector<float> texels(std::size_t{extent.width} * extent.height * floatChannelsOf(texture.desc.format));
  const auto bytes = static_cast<GLsizei>(texels.size() * sizeof(float));
  switch (classOf(texture.desc.format)) {
    case FormatClass::floating:
      getLayer(texture, mip, layer, GL_RGBA, GL_FLOAT, bytes, texels.data());
      break;
    case FormatClass::depth:
    case FormatClass::depth_stencil:
      getLayer(texture, mip, layer, GL_DEPTH_COMPONENT, GL_FLOAT, bytes, texels.data());
      break;
    case FormatClass::unsigned_integer:
      getLayer(texture, mip, layer, GL_RGBA_INTEGER, GL_UNSIGNED_INT, bytes, texels.data());
      for (float& texel : texels) texel = static_cast<float>(std::bit_cast<std::uint32_t>(texel));
      break;
    case FormatClass::signed_integer:
      getLayer(texture, mip, layer, GL_RGBA_INTEGER, GL_INT, bytes, texels.data());
      for (float& texel : texels) texel = static_cast<float>(std::bit_cast<std::int32_t>(texel));
      break;
  }
  return texels;
}

void readTextureInto(const TextureRef& texture, std::uint32_t mip, std::uint32_t layer, GLenum format,
                     GLenum type, GLuint buffer, std::uint64_t offset, std::uint64_t bytes) {
  assert(bytes >= static_cast<std::uint64_t>(byteCount(extentOf(texture.desc, mip), format, type)));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer);
  getLayer(texture, mip, layer, format, type, static_cast<GLsizei>(bytes), reinterpret_cast<void*>(offset));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

void uploadBuffer(GLuint buffer, std::uint64_t offset, std::span<const std::byte> data) {
  glNamedBufferSubData(buffer, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size()),
                       data.data());
}

std::vector<std::byte> readBuffer(GLuint buffer, std::uint64_t offset, std::uint64_t bytes) {
  std::vector<std::byte> data(bytes);
  glGetNamedBufferSubData(buffer, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data.data());
  return data;
}

}  // namespace weft::gl
