#include "engine/gl/objects/objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cstring>
#include <initializer_list>
#include <tuple>

#include "engine/gl/context/debug.h"
#include "engine/gl/context/state.h"
#include "gl_sentences.h"

namespace weft::gl {

namespace {

constexpr std::size_t kKinds = static_cast<std::size_t>(ObjectKind::count_);
std::array<std::atomic<std::int64_t>, kKinds> g_live{};

std::atomic<std::int64_t>& live(ObjectKind kind) {
  return g_live[static_cast<std::size_t>(kind)];
}

}  // namespace

std::int64_t liveObjects(ObjectKind kind) {
  return live(kind);
}

std::string liveObjects() {
  static constexpr const char* kNames[kKinds] = {
      "texture", "buffer", "framebuffer", "sampler", "vertex array", "query", "fence", "shader", "program"};
  std::string text;
  for (std::size_t i = 0; i < kKinds; ++i)
    if (const std::int64_t n = g_live[i]; n != 0)
      text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", n, kNames[i], n == 1 ? "" : "s");
  return text.empty() ? "none" : text;
}

void countObject(ObjectKind kind) {
  ++live(kind);
}

void deleteObject(ObjectKind kind, GLuint id) {
  --live(kind);
  if (kind == ObjectKind::texture) glDeleteTextures(1, &id);
  if (kind == ObjectKind::buffer) glDeleteBuffers(1, &id);
  if (kind == ObjectKind::framebuffer) glDeleteFramebuffers(1, &id);
  if (kind == ObjectKind::sampler) glDeleteSamplers(1, &id);
  if (kind == ObjectKind::vertex_array) glDeleteVertexArrays(1, &id);
  if (kind == ObjectKind::query) glDeleteQueries(1, &id);
  if (kind == ObjectKind::shader) glDeleteShader(id);
  if (kind == ObjectKind::program) glDeleteProgram(id);
}

std::optional<Buffer> Buffer::create(std::uint64_t bytes, GLbitfield flags, std::string_view label,
                                     text::Diagnostics& diagnostics, const void* data) {
  assert(bytes > 0);
  GLuint id = 0;
  glCreateBuffers(1, &id);
  Buffer buffer(id);
  // workarounds.md: storage-flag-without-storage. Errors from before are in the debug log and would be taken for ours.
  takeErrors();
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(bytes), data, flags);
  if (const std::string errors = takeErrors(); !errors.empty()) {
    diagnostics.error(say::bufferNotCreated, {}, label, bytes, errors, std::string(label));
    return std::nullopt;
  }
  buffer.bytes_ = bytes;
  labelObject(GL_BUFFER, id, label);
  return buffer;
}

SamplerObject SamplerObject::create(std::string_view label) {
  GLuint id = 0;
  glCreateSamplers(1, &id);
  SamplerObject sampler(id);
  labelObject(GL_SAMPLER, id, label);
  return sampler;
}

VertexArray VertexArray::create(std::string_view label) {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  VertexArray array(id);
  labelObject(GL_VERTEX_ARRAY, id, label);
  return array;
}

void VertexArray::setVertices(GLuint binding, GLuint buffer, std::uint64_t offset, std::uint32_t stride,
                              std::span<const VertexAttribute> attributes, GLuint divisor) {
  glVertexArrayVertexBuffer(id_, binding, buffer, static_cast<GLintptr>(offset),
                            static_cast<GLsizei>(stride));
  glVertexArrayBindingDivisor(id_, binding, divisor);
  for (const VertexAttribute& attribute : attributes) {
    glEnableVertexArrayAttrib(id_, attribute.location);
    if (attribute.integer)
      glVertexArrayAttribIFormat(id_, attribute.location, attribute.components, attribute.type,
                                 attribute.offset);
    else
      glVertexArrayAttribFormat(id_, attribute.location, attribute.components, attribute.type, GL_FALSE,
                                attribute.offset);
    glVertexArrayAttribBinding(id_, attribute.location, binding);
  }
}

Query Query::create(GLenum target, std::string_view label) {
  GLuint id = 0;
  glCreateQueries(target, 1, &id);
  Query query(id);
  labelObject(GL_QUERY, id, label);
  return query;
}

bool Query::available() const {
  GLint done = 0;
  glGetQueryObjectiv(id_, GL_QUERY_RESULT_AVAILABLE, &done);
  return done != 0;
}

std::uint64_t Query::result() const {
  GLuint64 value = 0;
  glGetQueryObjectui64v(id_, GL_QUERY_RESULT, &value);
  return value;
}

Fence Fence::insert() {
  Fence fence;
  fence.sync_.reset(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
  if (fence) countObject(ObjectKind::fence);
  return fence;
}

bool Fence::wait(std::uint64_t nanoseconds) const {
  if (!sync_) return true;
  const GLenum state = glClientWaitSync(sync_.get(), GL_SYNC_FLUSH_COMMANDS_BIT, nanoseconds);
  return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
}

void Fence::Delete::operator()(GLsync sync) const {
  --live(ObjectKind::fence);
  glDeleteSync(sync);
}

// ---- textures, views of them and framebuffers ----

namespace {

bool isMultisample(GLenum target) {
  return target == GL_TEXTURE_2D_MULTISAMPLE;
}

std::string sizeText(const TextureDesc& d) {
  std::string text = fmt::format("{}x{}", d.width, d.height);
  if (d.target == GL_TEXTURE_3D) text += fmt::format("x{}", d.depth);
  if (d.layers > 1) text += fmt::format(", {} layers", d.layers);
  if (d.mips > 1) text += fmt::format(", {} mips", d.mips);
  if (d.samples > 1) text += fmt::format(", {} samples", d.samples);
  return text + " " + enumName(d.format);
}

// Which number the driver would refuse, or "": it says no more than that it does.
std::string refusal(const TextureDesc& d) {
  const bool cube = d.target == GL_TEXTURE_CUBE_MAP || d.target == GL_TEXTURE_CUBE_MAP_ARRAY;
  const GLint largest = integerOf(d.target == GL_TEXTURE_3D ? GL_MAX_3D_TEXTURE_SIZE
                                  : cube                    ? GL_MAX_CUBE_MAP_TEXTURE_SIZE
                                                            : GL_MAX_TEXTURE_SIZE);
  const GLint layers = integerOf(GL_MAX_ARRAY_TEXTURE_LAYERS), samples = integerOf(GL_MAX_SAMPLES);
  const std::uint32_t side = std::max({d.width, d.height, d.target == GL_TEXTURE_3D ? d.depth : 1});
  for (const auto& [asked, most, what] : {std::tuple{side, largest, "texels on its largest side"},
                                          {d.mips, std::bit_width(side), "mips of this size"},
                                          {d.layers, layers, "layers"},
                                          {d.samples, samples, "samples"}})
    if (asked > static_cast<std::uint32_t>(most))
      return fmt::format("at most {} {} are allowed here", most, what);
  return "";
}

// Filters and wrapping of a texture or view that is read without a sampler object.
void setDefaults(GLuint id, GLenum target, std::uint32_t mips) {
  if (isMultisample(target)) return;
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, mips > 1 ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTextureParameteri(id, axis, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(mips) - 1);
}

}  // namespace

std::optional<Texture> Texture::create(const TextureDesc& desc, std::string_view label,
                                       text::Diagnostics& diagnostics) {
  const auto fail = [&](const std::string& reason) {
    diagnostics.error(say::textureNotCreated, {}, label, sizeText(desc), reason, std::string(label));
    return std::nullopt;
  };
  if (const std::string reason = refusal(desc); !reason.empty()) return fail(reason);
  GLuint id = 0;
  glCreateTextures(desc.target, 1, &id);
  Texture texture(id);
  texture.desc_ = desc;
  const auto [mips, width, height, depth, layers, samples] =
      std::array{static_cast<GLsizei>(desc.mips),   static_cast<GLsizei>(desc.width),
                 static_cast<GLsizei>(desc.height), static_cast<GLsizei>(desc.depth),
                 static_cast<GLsizei>(desc.layers), static_cast<GLsizei>(desc.samples)};
  switch (desc.target) {
    case GL_TEXTURE_2D:
    case GL_TEXTURE_CUBE_MAP:
      glTextureStorage2D(id, mips, desc.format, width, height);
      break;
    case GL_TEXTURE_2D_ARRAY:
    case GL_TEXTURE_CUBE_MAP_ARRAY:
      glTextureStorage3D(id, mips, desc.format, width, height, layers);
      break;
    case GL_TEXTURE_3D:
      glTextureStorage3D(id, mips, desc.format, width, height, depth);
      break;
    case GL_TEXTURE_2D_MULTISAMPLE:
      glTextureStorage2DMultisample(id, samples, desc.format, width, height, GL_TRUE);
      break;
    default:
      return fail(fmt::format("{} is no target of this engine", enumName(desc.target)));
  }
  GLint stored = 0;
  glGetTextureParameteriv(id, GL_TEXTURE_IMMUTABLE_FORMAT, &stored);
  if (!stored) return fail(takeErrors());
  setDefaults(id, desc.target, desc.mips);
  labelObject(GL_TEXTURE, id, label);
  return texture;
}

std::optional<Texture> Texture::create(const TextureRef& of, const ViewDesc& view, std::string_view label,
                                       text::Diagnostics& diagnostics) {
  GLuint id = 0;
  glGenTextures(1, &id);  // workarounds.md: view-names-from-gen
  Texture texture(id);
  const GLenum format = view.format == 0 ? of.desc.format : view.format;
  glTextureView(id, view.target, of.id, format, view.mip, view.mips, view.layer, view.layers);
  if (!glIsTexture(id)) {
    diagnostics.error(say::viewNotCreated, {}, label, sizeText(of.desc), takeErrors(), enumName(view.target),
                      enumName(format), view.mip, view.mip + view.mips - 1, view.layer,
                      view.layer + view.layers - 1);
    return std::nullopt;
  }
  texture.desc_ = of.desc;
  texture.desc_.target = view.target;
  texture.desc_.format = format;
  texture.desc_.width = std::max(1u, of.desc.width >> view.mip);
  texture.desc_.height = std::max(1u, of.desc.height >> view.mip);
  texture.desc_.depth = std::max(1u, of.desc.depth >> view.mip);
  texture.desc_.layers = view.layers;
  texture.desc_.mips = view.mips;
  setDefaults(id, view.target, view.mips);
  if (view.stencil)
    glTextureParameteri(id, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);  // workarounds.md: stencil-view
  labelObject(GL_TEXTURE, id, label);
  return texture;
}

std::optional<Framebuffer> Framebuffer::create(std::span<const Attachment> attachments,
                                               std::string_view label, text::Diagnostics& diagnostics,
                                               const Raster& raster) {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  Framebuffer framebuffer(id);
  std::array<GLenum, 32> draws{};
  GLsizei drawCount = 0;
  for (const Attachment& a : attachments) {
    if (a.layer < 0)
      glNamedFramebufferTexture(id, a.point, a.texture, static_cast<GLint>(a.mip));
    else
      glNamedFramebufferTextureLayer(id, a.point, a.texture, static_cast<GLint>(a.mip), a.layer);
    if (a.point >= GL_COLOR_ATTACHMENT0 && a.point < GL_COLOR_ATTACHMENT0 + draws.size()) {
      const auto index = static_cast<GLsizei>(a.point - GL_COLOR_ATTACHMENT0);
      draws[static_cast<std::size_t>(index)] = a.point;
      drawCount = std::max(drawCount, index + 1);
    }
  }
  glNamedFramebufferDrawBuffers(id, drawCount, draws.data());  // absent ones are GL_NONE, which is 0
  glNamedFramebufferReadBuffer(id, drawCount > 0 && draws[0] != GL_NONE ? draws[0] : GL_NONE);
  if (raster.width > 0) {
    glNamedFramebufferParameteri(id, GL_FRAMEBUFFER_DEFAULT_WIDTH, static_cast<GLint>(raster.width));
    glNamedFramebufferParameteri(id, GL_FRAMEBUFFER_DEFAULT_HEIGHT, static_cast<GLint>(raster.height));
    glNamedFramebufferParameteri(id, GL_FRAMEBUFFER_DEFAULT_SAMPLES,
                                 raster.samples > 1 ? static_cast<GLint>(raster.samples) : 0);
  }
  labelObject(GL_FRAMEBUFFER, id, label);
  const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return framebuffer;

  std::string parts;
  for (const Attachment& a : attachments) {
    GLint format = 0, samples = 0;
    if (glIsTexture(a.texture)) {
      glGetTextureLevelParameteriv(a.texture, static_cast<GLint>(a.mip), GL_TEXTURE_INTERNAL_FORMAT, &format);
      glGetTextureLevelParameteriv(a.texture, static_cast<GLint>(a.mip), GL_TEXTURE_SAMPLES, &samples);
    }
    parts += fmt::format("{}{} mip {} layer {} samples {}", parts.empty() ? "" : "; ",
                         enumName(static_cast<GLenum>(format)), a.mip, a.layer, samples);
  }
  const std::string errors = takeErrors();
  diagnostics.error(say::incompleteFramebuffer, {}, label, enumName(status), errors.empty() ? "" : ", ",
                    errors, parts.empty() ? "no attachments" : parts);
  return std::nullopt;
}

// ---- synchronous uploads and read-backs, and the sizes and classes they need ----

namespace {

bool isOneOf(GLenum value, std::initializer_list<GLenum> values) {
  return std::ranges::find(values, value) != values.end();
}

GLint toInt(std::uint32_t value) {
  return static_cast<GLint>(value);
}

std::size_t byteCount(const Extent& extent, GLenum format, GLenum type) {
  return std::size_t{extent.width} * extent.height * texelBytes(format, type);
}

}  // namespace

Extent extentOf(const TextureDesc& desc, std::uint32_t mip) {
  Extent extent{std::max(1u, desc.width >> mip), std::max(1u, desc.height >> mip), desc.layers};
  if (desc.target == GL_TEXTURE_3D) extent.layers = std::max(1u, desc.depth >> mip);
  return extent;
}

std::uint32_t texelBytes(GLenum format, GLenum type) {
  if (type == GL_FLOAT_32_UNSIGNED_INT_24_8_REV) return 8;
  if (isOneOf(type, {GL_UNSIGNED_INT_2_10_10_10_REV, GL_UNSIGNED_INT_10F_11F_11F_REV,
                     GL_UNSIGNED_INT_5_9_9_9_REV, GL_UNSIGNED_INT_24_8}))
    return 4;
  const std::uint32_t channels = isOneOf(format, {GL_RGBA, GL_BGRA, GL_RGBA_INTEGER}) ? 4
                                 : isOneOf(format, {GL_RGB, GL_RGB_INTEGER})          ? 3
                                 : isOneOf(format, {GL_RG, GL_RG_INTEGER})            ? 2
                                                                                      : 1;
  return channels * (isOneOf(type, {GL_UNSIGNED_BYTE, GL_BYTE})                    ? 1
                     : isOneOf(type, {GL_UNSIGNED_SHORT, GL_SHORT, GL_HALF_FLOAT}) ? 2
                                                                                   : 4);
}

FormatClass classOf(GLenum format) {
  if (isOneOf(format,
              {GL_R8UI, GL_RGBA8UI, GL_R16UI, GL_RG16UI, GL_RGBA16UI, GL_R32UI, GL_RG32UI, GL_RGBA32UI}))
    return FormatClass::unsigned_integer;
  if (isOneOf(format, {GL_R32I, GL_RG32I, GL_RGBA32I})) return FormatClass::signed_integer;
  if (isOneOf(format, {GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F}))
    return FormatClass::depth;
  if (isOneOf(format, {GL_DEPTH24_STENCIL8, GL_DEPTH32F_STENCIL8})) return FormatClass::depth_stencil;
  return FormatClass::floating;
}

GLenum attachmentPointOf(GLenum format) {
  const FormatClass kind = classOf(format);
  return kind == FormatClass::depth           ? GL_DEPTH_ATTACHMENT
         : kind == FormatClass::depth_stencil ? GL_DEPTH_STENCIL_ATTACHMENT
                                              : GL_COLOR_ATTACHMENT0;
}

bool resolveSamples(const TextureRef& from, GLuint to) {
  text::Diagnostics ignored;
  const GLenum point = attachmentPointOf(from.desc.format);
  const Attachment ends[] = {{.point = point, .texture = from.id}, {.point = point, .texture = to}};
  const auto source = Framebuffer::create({&ends[0], 1}, "samples", ignored),
             target = Framebuffer::create({&ends[1], 1}, "samples", ignored);
  if (!source || !target) return false;
  openMasks();
  const GLint width = toInt(from.desc.width), height = toInt(from.desc.height);
  const GLbitfield mask = point == GL_COLOR_ATTACHMENT0  ? GL_COLOR_BUFFER_BIT
                          : point == GL_DEPTH_ATTACHMENT ? GL_DEPTH_BUFFER_BIT
                                                         : GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT;
  glBlitNamedFramebuffer(source->id(), target->id(), 0, 0, width, height, 0, 0, width, height, mask,
                         GL_NEAREST);
  return true;
}

ClientFormat clientFormatOf(GLenum internalFormat) {
  const FormatClass kind = classOf(internalFormat);
  if (kind == FormatClass::depth || kind == FormatClass::depth_stencil)
    return {GL_DEPTH_COMPONENT, GL_FLOAT, 1};
  if (kind == FormatClass::floating) return {};
  return {GL_RGBA_INTEGER,
          static_cast<GLenum>(kind == FormatClass::signed_integer ? GL_INT : GL_UNSIGNED_INT), 4};
}

void uploadTexture(const TextureRef& texture, std::uint32_t mip, std::uint32_t layer, GLenum format,
                   GLenum type, std::span<const std::byte> data) {
  const Extent extent = extentOf(texture.desc, mip);
  assert(mip < texture.desc.mips && layer < extent.layers && texture.desc.samples == 1);
  assert(data.size() == byteCount(extent, format, type));
  const GLsizei width = toInt(extent.width), height = toInt(extent.height);
  if (texture.desc.target == GL_TEXTURE_2D)
    glTextureSubImage2D(texture.id, toInt(mip), 0, 0, width, height, format, type, data.data());
  else
    glTextureSubImage3D(texture.id, toInt(mip), 0, 0, toInt(layer), width, height, 1, format, type,
                        data.data());
}

std::vector<std::byte> readTexture(const TextureRef& texture, std::uint32_t mip, std::uint32_t layer,
                                   GLenum format, GLenum type) {
  const Extent extent = extentOf(texture.desc, mip);
  assert(mip < texture.desc.mips && layer < extent.layers && texture.desc.samples == 1);
  std::vector<std::byte> data(byteCount(extent, format, type));
  const auto row = static_cast<std::uint32_t>(data.size() / extent.height),
             some = std::max(1u, (64u << 20) / row);
  for (std::uint32_t y = 0; y < extent.height; y += some) {  // OpenGL counts the bytes of one call in 31 bits
    const std::uint32_t rows = std::min(some, extent.height - y);
    glGetTextureSubImage(texture.id, toInt(mip), 0, toInt(y), toInt(layer), toInt(extent.width), toInt(rows),
                         1, format, type, toInt(rows * row), &data[std::size_t{y} * row]);
  }
  return data;
}

std::vector<float> readFloats(const TextureRef& texture, std::uint32_t mip, std::uint32_t layer) {
  const ClientFormat client = clientFormatOf(texture.desc.format);
  const std::vector<std::byte> bytes = readTexture(texture, mip, layer, client.format, client.type);
  std::vector<float> texels(bytes.size() / sizeof(float));
  std::memcpy(texels.data(), bytes.data(), bytes.size());
  if (client.type == GL_UNSIGNED_INT)
    for (float& texel : texels) texel = static_cast<float>(std::bit_cast<std::uint32_t>(texel));
  if (client.type == GL_INT)
    for (float& texel : texels) texel = static_cast<float>(std::bit_cast<std::int32_t>(texel));
  return texels;
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
