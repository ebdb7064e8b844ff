#include "engine/gl/objects/objects.h"

#include <fmt/format.h>

#include <atomic>
#include <cassert>

#include "engine/gl/context/debug.h"

namespace weft::gl {

namespace {

constexpr std::size_t kKinds = static_cast<std::size_t>(ObjectKind::count_);
std::array<std::atomic<std::int64_t>, kKinds> g_live{};

void count(ObjectKind kind, std::int64_t by) {
  g_live[static_cast<std::size_t>(kind)] += by;
}

}  // namespace

std::int64_t LiveObjects::total() const {
  std::int64_t sum = 0;
  for (const auto n : counts) sum += n;
  return sum;
}

LiveObjects liveObjects() {
  LiveObjects live;
  for (std::size_t i = 0; i < kKinds; ++i) live.counts[i] = g_live[i];
  return live;
}

std::string toText(const LiveObjects& objects) {
  static constexpr const char* kNames[kKinds] = {"texture",     "texture view", "buffer",
                                                 "framebuffer", "sampler",      "vertex array",
                                                 "query",       "fence",        "program"};
  std::string text;
  for (std::size_t i = 0; i < kKinds; ++i)
    if (const auto n = objects.counts[i]; n != 0)
      text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", n, kNames[i], n == 1 ? "" : "s");
  return text.empty() ? "none" : text;
}

template <ObjectKind kKind>
Owner<kKind>::Owner(GLuint id) : id_(id) {
  assert(id != 0);
  count(kKind, 1);
}

template <ObjectKind kKind>
void Owner<kKind>::reset() {
  if (id_ == 0) return;
  if constexpr (kKind == ObjectKind::texture || kKind == ObjectKind::view) glDeleteTextures(1, &id_);
  if constexpr (kKind == ObjectKind::buffer) glDeleteBuffers(1, &id_);
  if constexpr (kKind == ObjectKind::framebuffer) glDeleteFramebuffers(1, &id_);
  if constexpr (kKind == ObjectKind::sampler) glDeleteSamplers(1, &id_);
  if constexpr (kKind == ObjectKind::vertex_array) glDeleteVertexArrays(1, &id_);
  if constexpr (kKind == ObjectKind::query) glDeleteQueries(1, &id_);
  if constexpr (kKind == ObjectKind::program) glDeleteProgram(id_);
  id_ = 0;
  count(kKind, -1);
}

template class Owner<ObjectKind::texture>;
template class Owner<ObjectKind::view>;
template class Owner<ObjectKind::buffer>;
template class Owner<ObjectKind::framebuffer>;
template class Owner<ObjectKind::sampler>;
template class Owner<ObjectKind::vertex_array>;
template class Owner<ObjectKind::query>;
template class Owner<ObjectKind::program>;

std::optional<Buffer> Buffer::create(std::uint64_t bytes, GLbitfield flags, std::string_view label,
                                     base::Diagnostics& diagnostics, const void* data) {
  assert(bytes > 0);
  GLuint id = 0;
  glCreateBuffers(1, &id);
  Buffer buffer(id);
  // workarounds.h: storage-flag-without-storage. Errors from before are in the debug log and would be taken
  // for ours.
  takeErrors();
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(bytes), data, flags);
  if (const std::string errors = takeErrors(); !errors.empty()) {
    diagnostics
        .error(base::Code::bufferNotCreated, {},
               fmt::format("buffer '{}' of {} bytes cannot be created: {}", label, bytes, errors))
        .resource = label;
    return std::nullopt;
  }
  buffer.bytes_ = bytes;
  labelObject(GL_BUFFER, id, label);
  return buffer;
}

SamplerObject SamplerObject::create(const SamplerDesc& desc, std::string_view label) {
  GLuint id = 0;
  glCreateSamplers(1, &id);
  SamplerObject sampler(id);
  glSamplerParameteri(id, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(desc.minFilter));
  glSamplerParameteri(id, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(desc.magFilter));
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glSamplerParameteri(id, axis, static_cast<GLint>(desc.wrap));
  if (desc.compare != 0) {
    glSamplerParameteri(id, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(id, GL_TEXTURE_COMPARE_FUNC, static_cast<GLint>(desc.compare));
  }
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
  fence.sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (fence.sync_) count(ObjectKind::fence, 1);
  return fence;
}

Fence& Fence::operator=(Fence&& other) noexcept {
  if (this != &other) {
    reset();
    sync_ = std::exchange(other.sync_, nullptr);
  }
  return *this;
}

bool Fence::wait(std::uint64_t nanoseconds) const {
  if (!sync_) return true;
  const GLenum state = glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, nanoseconds);
  return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
}

void Fence::reset() {
  if (!sync_) return;
  glDeleteSync(sync_);
  sync_ = nullptr;
  count(ObjectKind::fence, -1);
}

}  // namespace weft::gl
