// Move-only owners of GL objects, labeled for debug tools and counted per kind (leak tests). Creation that
// depends on the machine or on an author's numbers returns an optional and a diagnostic; everything else
// asserts. All functions act on the current context; an object must be destroyed in the context that made it. An
// object that is default-made or moved from owns nothing.
#pragma once

#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::gl {

enum class ObjectKind : std::uint8_t {
  texture,
  buffer,
  framebuffer,
  sampler,
  vertex_array,
  query,
  fence,
  shader,
  program,
  count_
};

// Objects of this process that are alive: of a kind; of all kinds, "2 textures, 1 buffer" or "none".
std::int64_t liveObjects(ObjectKind kind);
std::string liveObjects();

void countObject(ObjectKind kind);  // one more
void deleteObject(ObjectKind kind, GLuint id);

// Shared ownership mechanics: an id that is deleted with its owner.
template <ObjectKind kKind>
class Owner {
 public:
  Owner() = default;
  Owner(Owner&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Owner& operator=(Owner&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, 0);
    }
    return *this;
  }
  ~Owner() { reset(); }
  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }
  void reset() {
    if (id_ != 0) deleteObject(kKind, std::exchange(id_, 0));
  }

 protected:
  explicit Owner(GLuint id) : id_(id) { countObject(kKind); }
  GLuint id_ = 0;
};

// Immutable storage. layers counts array layers, for cubes six per cube (6 for GL_TEXTURE_CUBE_MAP).
struct TextureDesc {
  GLenum target = GL_TEXTURE_2D;  // 2D, 2D_ARRAY, CUBE_MAP, CUBE_MAP_ARRAY, 3D, 2D_MULTISAMPLE
  GLenum format = GL_RGBA8;       // sized internal format
  std::uint32_t width = 1, height = 1, depth = 1;  // depth: 3D only
  std::uint32_t layers = 1, mips = 1, samples = 1;
  friend bool operator==(const TextureDesc&, const TextureDesc&) = default;
};

// A texture, or a view of one, for code that binds, attaches, uploads or reads it. Does not own it.
struct TextureRef {
  GLuint id = 0;
  TextureDesc desc;
};

struct ViewDesc {
  GLenum target = GL_TEXTURE_2D;
  GLenum format = 0;  // 0: the texture's own; others must be in its view class (depth: its own only)
  std::uint32_t mip = 0, mips = 1, layer = 0, layers = 1;
  bool stencil = false;  // sampling yields the stencil index (usampler) of a depth-stencil texture
  friend bool operator==(const ViewDesc&, const ViewDesc&) = default;
};

class Texture : public Owner<ObjectKind::texture> {
 public:
  // Reports W116 when the driver's limits or memory do not allow it. Filters are set to nearest, wrapping to clamp
  // to edge, GL_TEXTURE_MAX_LEVEL to mips - 1. Contents are undefined.
  static std::optional<Texture> create(const TextureDesc& desc, std::string_view label,
                                       text::Diagnostics& diagnostics);
  // A view, which shares the storage of `of` and keeps that alive. Reports W118 when the driver rejects it (range, target, class).
  static std::optional<Texture> create(const TextureRef& of, const ViewDesc& view, std::string_view label,
                                       text::Diagnostics& diagnostics);
  const TextureDesc& desc() const { return desc_; }  // of a view: sizes of its level 0
  TextureRef ref() const { return {id_, desc_}; }

 private:
  using Owner::Owner;
  TextureDesc desc_;
};

class Buffer : public Owner<ObjectKind::buffer> {
 public:
  // Immutable storage of `bytes` (> 0); flags as for glNamedBufferStorage. Without `data` the contents are undefined.
  // Reports W117 when there is no memory.
  static std::optional<Buffer> create(std::uint64_t bytes, GLbitfield flags, std::string_view label,
                                      text::Diagnostics& diagnostics, const void* data = nullptr);
  std::uint64_t bytes() const { return bytes_; }

 private:
  using Owner::Owner;
  std::uint64_t bytes_ = 0;
};

struct Attachment {
  GLenum point = GL_COLOR_ATTACHMENT0;  // or one of depth, stencil or both
  GLuint texture = 0;
  std::uint32_t mip = 0;
  std::int32_t layer = -1;  // -1: the whole level (layered when it has layers); else one layer, face or slice
  friend bool operator==(const Attachment&, const Attachment&) = default;
};

// Of a framebuffer without attachments.
struct Raster {
  std::uint32_t width = 0, height = 0, samples = 1;
  friend bool operator==(const Raster&, const Raster&) = default;
};

struct Framebuffer : Owner<ObjectKind::framebuffer> {
  using Owner::Owner;
  // Draw buffer i writes GL_COLOR_ATTACHMENTi when that is attached, else nothing. Without attachments, `raster` is
  // the area that is rasterized. When the framebuffer is incomplete, reports W115 with the reason.
  static std::optional<Framebuffer> create(std::span<const Attachment> attachments, std::string_view label,
                                           text::Diagnostics& diagnostics, const Raster& raster = {});
};

struct SamplerObject : Owner<ObjectKind::sampler> {
  using Owner::Owner;
  static SamplerObject create(std::string_view label);  // with OpenGL's parameters
};

// Replaces an object by one of these arguments of its create(). False after an error; then the old one stays.
template <class Object, class... Arguments>
bool remake(Object& object, Arguments&&... arguments) {
  auto made = Object::create(std::forward<Arguments>(arguments)...);
  if (made) object = std::move(*made);
  return made.has_value();
}

struct VertexAttribute {
  GLuint location = 0;
  GLint components = 3;
  GLenum type = GL_FLOAT;
  std::uint32_t offset = 0;  // bytes into a vertex
  bool integer = false;
};

struct VertexArray : Owner<ObjectKind::vertex_array> {
  using Owner::Owner;
  static VertexArray create(std::string_view label);
  // Takes attributes from one interleaved buffer, at binding point `binding`. With `divisor` 1 each instance takes one
  // element. `buffer` may be 0. Buffers are not owned.
  void setVertices(GLuint binding, GLuint buffer, std::uint64_t offset, std::uint32_t stride,
                   std::span<const VertexAttribute> attributes, GLuint divisor = 0);
  void disable(std::span<const VertexAttribute> attributes) {
    for (const VertexAttribute& attribute : attributes) glDisableVertexArrayAttrib(id_, attribute.location);
  }
  void setIndices(GLuint buffer) { glVertexArrayElementBuffer(id_, buffer); }
};

struct Query : Owner<ObjectKind::query> {
  using Owner::Owner;
  static Query create(GLenum target, std::string_view label);  // GL_TIMESTAMP, GL_TIME_ELAPSED, …
  bool available() const;
  std::uint64_t result() const;  // waits when not available
};

// A fence sync object. Default-made: nothing was inserted and isSignalled() is true.
class Fence {
 public:
  static Fence insert();
  explicit operator bool() const { return sync_ != nullptr; }
  bool isSignalled() const { return wait(0); }  // never waits; flushes, so that the GPU gets to the fence
  bool wait(std::uint64_t nanoseconds) const;   // true when signalled within that time
  void reset() { sync_.reset(); }

 private:
  struct Delete {
    void operator()(GLsync sync) const;
  };
  std::unique_ptr<std::remove_pointer_t<GLsync>, Delete> sync_;
};

// ---- texels and bytes ----
// All of these wait until they are done. `layer` is an array layer, a cube's layer * 6 + face,
// or a 3D slice. Rows are bottom first and tightly packed.

struct Extent {
  std::uint32_t width = 1, height = 1, layers = 1;  // layers: array layers, faces, or slices of this level
};
Extent extentOf(const TextureDesc& desc, std::uint32_t mip);
// Levels of a full chain.
inline std::uint32_t mipsOf(std::uint32_t width, std::uint32_t height) {
  return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}

// Writes one layer of one level; data holds exactly width * height texels of (format, type).
void uploadTexture(const TextureRef& texture, std::uint32_t mip, std::uint32_t layer, GLenum format,
                   GLenum type, std::span<const std::byte> data);
// One layer of one level as bytes of (format, type).
std::vector<std::byte> readTexture(const TextureRef& texture, std::uint32_t mip, std::uint32_t layer,
                                   GLenum format, GLenum type);
// The same as floats, four per texel (missing channels 0, alpha 1); depth formats: one per texel; integer
// formats are converted from their exact values.
std::vector<float> readFloats(const TextureRef& texture, std::uint32_t mip = 0, std::uint32_t layer = 0);
// As what texels of an internal format are read: as numbers of 32 bits, `channels` a texel: 4, or 1 for depth.
struct ClientFormat {
  GLenum format = GL_RGBA, type = GL_FLOAT;
  std::uint32_t channels = 4;
};
ClientFormat clientFormatOf(GLenum internalFormat);
// The buffer was created with GL_DYNAMIC_STORAGE_BIT.
void uploadBuffer(GLuint buffer, std::uint64_t offset, std::span<const std::byte> data);
std::vector<std::byte> readBuffer(GLuint buffer, std::uint64_t offset, std::uint64_t bytes);

// Bytes per texel of a client format and type, such as GL_RGBA and GL_HALF_FLOAT.
std::uint32_t texelBytes(GLenum format, GLenum type);
// Whether an internal format holds unsigned or signed integers, depth, or depth and stencil.
enum class FormatClass : std::uint8_t { floating, unsigned_integer, signed_integer, depth, depth_stencil };
FormatClass classOf(GLenum internalFormat);
// GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT or GL_DEPTH_STENCIL_ATTACHMENT, by the internal format.
GLenum attachmentPointOf(GLenum internalFormat);
// Writes the mean of the samples, or the first sample of depth and stencil, of a texture to one of the same format and size.
// False when the driver has no framebuffer for them.
bool resolveSamples(const TextureRef& from, GLuint to);

// The rows of a picture, of `row` numbers each, the last one first.
template <class To, class From>
std::vector<To> flipped(const std::vector<From>& texels, std::size_t row) {
  std::vector<To> out;
  out.reserve(texels.size());
  for (std::size_t end = texels.size(); end > 0; end -= row)
    for (std::size_t i = end - row; i < end; ++i) out.push_back(static_cast<To>(texels[i]));
  return out;
}

}  // namespace weft::gl
