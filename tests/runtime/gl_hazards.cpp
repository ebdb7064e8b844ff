#include "tests/runtime/gl_hazards.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "engine/gl/context/debug.h"
#include "engine/gl/programs/program.h"
#include "engine/glsl/tokens.h"

namespace weft::runtime::test {

namespace {

constexpr GLbitfield kAnyCopy =
    GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT;
constexpr std::int64_t kAll = std::int64_t{1} << 40;

struct Texture {
  std::uint64_t root = 0;
  std::int64_t level = 0, levels = kAll, layer = 0, layers = kAll;
  std::int64_t base = 0, most = kAll;  // levels that samplers see
};
struct Range {
  GLuint buffer = 0;
  std::int64_t begin = 0, end = kAll;
};
struct Image {
  GLuint texture = 0;
  GLint level = 0, layer = 0;
  bool layered = false, writes = false;
};
// What a linked program uses.
struct Uses {
  std::vector<GLuint> units, images, uniforms;
  std::vector<std::pair<GLuint, bool>> storages;  // binding, written
};

struct State {
  std::vector<GlEvent> events;
  std::vector<std::string> passes{""};
  std::vector<std::uint32_t> open{0};
  std::map<GLuint, Texture> textures;
  std::map<GLuint, std::uint64_t> buffers;
  std::map<std::uint64_t, std::string> names;
  std::uint64_t next = 1;
  std::map<GLuint, GLuint> units;
  std::map<GLuint, Image> images;
  std::map<std::pair<GLenum, GLuint>, Range> ranges;
  std::map<GLuint, std::map<GLenum, GlSpan>> framebuffers;
  std::map<GLuint, std::set<GLuint>> vertexBuffers;  // of a vertex array
  std::map<GLuint, GLuint> elements;
  GLuint program = 0, drawTo = 0, readFrom = 0, vertices = 0, drawCommands = 0, dispatchCommands = 0;
  std::map<GLuint, std::string> sources;
  std::map<GLuint, std::set<GLuint>> attached;
  std::map<GLuint, std::set<std::string>>
      written;  // storage blocks that a shader does not declare readonly, by program
  std::map<GLuint, Uses> uses;
};
State* state = nullptr;

Texture& textureOf(GLuint name) {
  Texture& texture = state->textures[name];
  if (texture.root == 0) texture.root = state->next++;
  return texture;
}
std::uint64_t bufferOf(GLuint name) {
  std::uint64_t& object = state->buffers[name];
  if (object == 0) object = state->next++;
  return object;
}

void touch(const GlSpan& span, GLbitfield bits, bool store = false) {
  state->events.push_back({.bits = bits, .store = store, .pass = state->open.back(), .span = span});
}
GlSpan spanOf(GLuint name, std::int64_t level, std::int64_t levels, std::int64_t layer = 0,
              std::int64_t layers = kAll) {
  const Texture& t = textureOf(name);
  return {t.root, t.level + level, t.level + std::min(level + levels, t.levels), t.layer + layer,
          t.layer + std::min(layer + layers, t.layers)};
}
GlSpan sampledSpan(GLuint name) {
  const Texture& t = textureOf(name);
  return spanOf(name, t.base, t.most - t.base);
}
GlSpan bytesOf(GLuint buffer, std::int64_t begin = 0, std::int64_t bytes = kAll) {
  return {bufferOf(buffer), begin, begin + bytes};
}

// "layout(std430) readonly buffer rows {": the names of blocks without the word.
void noteWritten(const std::string& source, std::set<std::string>& blocks) {
  const glsl::TokenList list = glsl::expandTokens(source, {}, 100);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < list.tokens.size(); ++i) {
    if (list.tokens[i].is(";") || list.tokens[i].is("}")) begin = i + 1;
    if (!list.tokens[i].is("{")) continue;
    bool buffer = false, readonly = false;
    for (std::size_t at = begin; at < i; ++at) {
      buffer = buffer || list.tokens[at].is("buffer");
      readonly = readonly || list.tokens[at].is("readonly");
    }
    if (buffer && !readonly && i > 0) blocks.insert(std::string(list.tokens[i - 1].text));
    begin = i + 1;
  }
}

const Uses& usesOf(GLuint program) {
  const auto known = state->uses.find(program);
  if (known != state->uses.end()) return known->second;
  Uses& uses = state->uses[program];
  const gl::Reflection reflection = gl::reflectProgram(program, false);
  for (const gl::OpaqueUniform& each : reflection.samplers)
    for (std::uint32_t i = 0; i < each.arraySize; ++i) uses.units.push_back(each.unit + i);
  for (const gl::OpaqueUniform& each : reflection.images)
    for (std::uint32_t i = 0; i < each.arraySize; ++i) uses.images.push_back(each.unit + i);
  for (const gl::Block& each : reflection.uniformBlocks) uses.uniforms.push_back(each.binding);
  for (const gl::Block& each : reflection.storageBlocks)
    uses.storages.emplace_back(each.binding,
                               state->written[program].contains(each.name.substr(0, each.name.find('['))));
  return uses;
}

void touchBound() {
  if (state->program == 0) return;
  const Uses& uses = usesOf(state->program);
  for (const GLuint unit : uses.units)
    if (const GLuint texture = state->units[unit]) touch(sampledSpan(texture), GL_TEXTURE_FETCH_BARRIER_BIT);
  for (const GLuint unit : uses.images) {
    const Image& image = state->images[unit];
    if (image.texture == 0) continue;
    touch(image.layered ? spanOf(image.texture, image.level, 1)
                        : spanOf(image.texture, image.level, 1, image.layer, 1),
          GL_SHADER_IMAGE_ACCESS_BARRIER_BIT, image.writes);
  }
  const auto bound = [](GLenum target, GLuint binding) {
    const Range& range = state->ranges[{target, binding}];
    return GlSpan{bufferOf(range.buffer), range.begin, range.end};
  };
  for (const GLuint binding : uses.uniforms) touch(bound(GL_UNIFORM_BUFFER, binding), GL_UNIFORM_BARRIER_BIT);
  for (const auto& [binding, written] : uses.storages)
    touch(bound(GL_SHADER_STORAGE_BUFFER, binding), GL_SHADER_STORAGE_BARRIER_BIT, written);
}
void touchAttached(GLuint framebuffer) {
  for (const auto& [point, span] : state->framebuffers[framebuffer]) touch(span, GL_FRAMEBUFFER_BARRIER_BIT);
}
void noteDraw(bool elements) {
  touchBound();
  touchAttached(state->drawTo);
  for (const GLuint buffer : state->vertexBuffers[state->vertices])
    touch(bytesOf(buffer), GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
  if (elements) touch(bytesOf(state->elements[state->vertices]), GL_ELEMENT_ARRAY_BARRIER_BIT);
}
void clearAttached(GLuint framebuffer, GLenum buffer, GLint index) {
  const GLenum point = buffer == GL_COLOR ? GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(index) : 0;
  for (const auto& [at, span] : state->framebuffers[framebuffer])
    if (point != 0
            ? at == point
            : at == GL_DEPTH_ATTACHMENT || at == GL_STENCIL_ATTACHMENT || at == GL_DEPTH_STENCIL_ATTACHMENT)
      touch(span, GL_FRAMEBUFFER_BARRIER_BIT);
}

// Each hook: its name, its arguments, and what it notes before the call goes on.
// clang-format off
#define WEFT_TRACED(X) \
  X(MemoryBarrier, (GLbitfield bits), (bits), state->events.push_back({.kind = GlEvent::Kind::barrier, .bits = bits})) \
  X(PushDebugGroup, (GLenum source, GLuint id, GLsizei length, const GLchar* text), (source, id, length, text), \
    state->open.push_back(state->open.size() > 1 ? state->open.back() : static_cast<std::uint32_t>(state->passes.size())); \
    if (state->open.size() == 2) state->passes.push_back(length < 0 ? text : std::string(text, static_cast<std::size_t>(length)))) \
  X(PopDebugGroup, (), (), if (state->open.size() > 1) state->open.pop_back()) \
  X(UseProgram, (GLuint program), (program), state->program = program) \
  X(BindTextureUnit, (GLuint unit, GLuint texture), (unit, texture), state->units[unit] = texture) \
  X(BindImageTexture, (GLuint unit, GLuint texture, GLint level, GLboolean layered, GLint layer, GLenum access, GLenum format), \
    (unit, texture, level, layered, layer, access, format), (state->images[unit] = {texture, level, layer, layered != 0, access != GL_READ_ONLY})) \
  X(BindBufferRange, (GLenum target, GLuint index, GLuint buffer, GLintptr offset, GLsizeiptr size), (target, index, buffer, offset, size), \
    (state->ranges[{target, index}] = {buffer, offset, offset + size})) \
  X(BindBufferBase, (GLenum target, GLuint index, GLuint buffer), (target, index, buffer), (state->ranges[{target, index}] = {buffer, 0, kAll})) \
  X(BindBuffer, (GLenum target, GLuint buffer), (target, buffer), \
    (target == GL_DRAW_INDIRECT_BUFFER ? state->drawCommands : state->dispatchCommands) = buffer) \
  X(BindVertexArray, (GLuint vertices), (vertices), state->vertices = vertices) \
  X(VertexArrayVertexBuffer, (GLuint vertices, GLuint index, GLuint buffer, GLintptr offset, GLsizei stride), (vertices, index, buffer, offset, stride), \
    if (buffer != 0) state->vertexBuffers[vertices].insert(buffer)) \
  X(VertexArrayElementBuffer, (GLuint vertices, GLuint buffer), (vertices, buffer), state->elements[vertices] = buffer) \
  X(BindFramebuffer, (GLenum target, GLuint framebuffer), (target, framebuffer), \
    if (target != GL_READ_FRAMEBUFFER) state->drawTo = framebuffer; if (target != GL_DRAW_FRAMEBUFFER) state->readFrom = framebuffer) \
  X(NamedFramebufferTexture, (GLuint framebuffer, GLenum point, GLuint texture, GLint level), (framebuffer, point, texture, level), \
    if (texture != 0) state->framebuffers[framebuffer][point] = spanOf(texture, level, 1)) \
  X(NamedFramebufferTextureLayer, (GLuint framebuffer, GLenum point, GLuint texture, GLint level, GLint layer), \
    (framebuffer, point, texture, level, layer), if (texture != 0) state->framebuffers[framebuffer][point] = spanOf(texture, level, 1, layer, 1)) \
  X(TextureView, (GLuint view, GLenum target, GLuint origin, GLenum format, GLuint level, GLuint levels, GLuint layer, GLuint layers), \
    (view, target, origin, format, level, levels, layer, layers), \
    (state->textures[view] = {textureOf(origin).root, textureOf(origin).level + level, levels, textureOf(origin).layer + layer, layers})) \
  X(TextureParameteri, (GLuint texture, GLenum name, GLint value), (texture, name, value), \
    if (name == GL_TEXTURE_BASE_LEVEL) textureOf(texture).base = value; if (name == GL_TEXTURE_MAX_LEVEL) textureOf(texture).most = value + std::int64_t{1}) \
  X(DeleteTextures, (GLsizei count, const GLuint* names), (count, names), for (GLsizei i = 0; i < count; ++i) state->textures.erase(names[i])) \
  X(DeleteBuffers, (GLsizei count, const GLuint* names), (count, names), for (GLsizei i = 0; i < count; ++i) state->buffers.erase(names[i])) \
  X(DeleteFramebuffers, (GLsizei count, const GLuint* names), (count, names), for (GLsizei i = 0; i < count; ++i) state->framebuffers.erase(names[i])) \
  X(DeleteVertexArrays, (GLsizei count, const GLuint* names), (count, names), \
    for (GLsizei i = 0; i < count; ++i) { state->vertexBuffers.erase(names[i]); state->elements.erase(names[i]); }) \
  X(DeleteProgram, (GLuint program), (program), state->uses.erase(program); state->written.erase(program); state->attached.erase(program)) \
  X(ObjectLabel, (GLenum kind, GLuint name, GLsizei length, const GLchar* text), (kind, name, length, text), \
    if (kind == GL_TEXTURE || kind == GL_BUFFER) state->names[kind == GL_TEXTURE ? textureOf(name).root : bufferOf(name)] = \
      length < 0 ? text : std::string(text, static_cast<std::size_t>(length))) \
  X(ShaderSource, (GLuint shader, GLsizei count, const GLchar* const* texts, const GLint* lengths), (shader, count, texts, lengths), \
    state->sources[shader].clear(); \
    for (GLsizei i = 0; i < count; ++i) state->sources[shader] += lengths ? std::string(texts[i], static_cast<std::size_t>(lengths[i])) : texts[i]) \
  X(AttachShader, (GLuint program, GLuint shader), (program, shader), state->attached[program].insert(shader)) \
  X(LinkProgram, (GLuint program), (program), state->uses.erase(program); state->written[program].clear(); \
    for (const GLuint shader : state->attached[program]) noteWritten(state->sources[shader], state->written[program])) \
  X(DrawArrays, (GLenum mode, GLint first, GLsizei count), (mode, first, count), noteDraw(false)) \
  X(DrawArraysInstanced, (GLenum mode, GLint first, GLsizei count, GLsizei instances), (mode, first, count, instances), noteDraw(false)) \
  X(DrawElementsInstanced, (GLenum mode, GLsizei count, GLenum type, const void* at, GLsizei instances), (mode, count, type, at, instances), noteDraw(true)) \
  X(MultiDrawElementsIndirect, (GLenum mode, GLenum type, const void* at, GLsizei count, GLsizei stride), (mode, type, at, count, stride), \
    touch(bytesOf(state->drawCommands, reinterpret_cast<GLintptr>(at), count * 20), GL_COMMAND_BARRIER_BIT); noteDraw(true)) \
  X(MultiDrawArraysIndirect, (GLenum mode, const void* at, GLsizei count, GLsizei stride), (mode, at, count, stride), \
    touch(bytesOf(state->drawCommands, reinterpret_cast<GLintptr>(at), count * 16), GL_COMMAND_BARRIER_BIT); noteDraw(false)) \
  X(DispatchCompute, (GLuint x, GLuint y, GLuint z), (x, y, z), touchBound()) \
  X(DispatchComputeIndirect, (GLintptr at), (at), touch(bytesOf(state->dispatchCommands, at, 12), GL_COMMAND_BARRIER_BIT); touchBound()) \
  X(ClearNamedFramebufferfv, (GLuint to, GLenum buffer, GLint index, const GLfloat* value), (to, buffer, index, value), clearAttached(to, buffer, index)) \
  X(ClearNamedFramebufferiv, (GLuint to, GLenum buffer, GLint index, const GLint* value), (to, buffer, index, value), clearAttached(to, buffer, index)) \
  X(ClearNamedFramebufferuiv, (GLuint to, GLenum buffer, GLint index, const GLuint* value), (to, buffer, index, value), clearAttached(to, buffer, index)) \
  X(ClearNamedFramebufferfi, (GLuint to, GLenum buffer, GLint index, GLfloat depth, GLint stencil), (to, buffer, index, depth, stencil), \
    clearAttached(to, buffer, index)) \
  X(ClearTexSubImage, (GLuint texture, GLint level, GLint x, GLint y, GLint z, GLsizei w, GLsizei h, GLsizei d, GLenum format, GLenum type, const void* data), \
    (texture, level, x, y, z, w, h, d, format, type, data), touch(spanOf(texture, level, 1), GL_TEXTURE_UPDATE_BARRIER_BIT)) \
  X(ClearNamedBufferSubData, (GLuint buffer, GLenum internal, GLintptr at, GLsizeiptr bytes, GLenum format, GLenum type, const void* data), \
    (buffer, internal, at, bytes, format, type, data), touch(bytesOf(buffer, at, bytes), GL_BUFFER_UPDATE_BARRIER_BIT)) \
  X(NamedBufferSubData, (GLuint buffer, GLintptr at, GLsizeiptr bytes, const void* data), (buffer, at, bytes, data), \
    touch(bytesOf(buffer, at, bytes), GL_BUFFER_UPDATE_BARRIER_BIT)) \
  X(CopyNamedBufferSubData, (GLuint from, GLuint to, GLintptr at, GLintptr there, GLsizeiptr bytes), (from, to, at, there, bytes), \
    touch(bytesOf(from, at, bytes), GL_BUFFER_UPDATE_BARRIER_BIT); touch(bytesOf(to, there, bytes), GL_BUFFER_UPDATE_BARRIER_BIT)) \
  X(TextureSubImage2D, (GLuint texture, GLint level, GLint x, GLint y, GLsizei w, GLsizei h, GLenum format, GLenum type, const void* data), \
    (texture, level, x, y, w, h, format, type, data), touch(spanOf(texture, level, 1), GL_TEXTURE_UPDATE_BARRIER_BIT)) \
  X(BlitNamedFramebuffer, (GLuint from, GLuint to, GLint a, GLint b, GLint c, GLint d, GLint e, GLint f, GLint g, GLint h, GLbitfield planes, GLenum filter), \
    (from, to, a, b, c, d, e, f, g, h, planes, filter), touchAttached(from); touchAttached(to)) \
  X(CopyImageSubData, (GLuint from, GLenum fromTarget, GLint fromLevel, GLint a, GLint b, GLint c, GLuint to, GLenum toTarget, GLint toLevel, GLint d, GLint e, \
    GLint f, GLsizei w, GLsizei h, GLsizei depth), (from, fromTarget, fromLevel, a, b, c, to, toTarget, toLevel, d, e, f, w, h, depth), \
    touch(spanOf(from, fromLevel, 1), kAnyCopy); touch(spanOf(to, toLevel, 1), kAnyCopy)) \
  X(GenerateTextureMipmap, (GLuint texture), (texture), touch(sampledSpan(texture), kAnyCopy)) \
  X(ReadPixels, (GLint x, GLint y, GLsizei w, GLsizei h, GLenum format, GLenum type, void* data), (x, y, w, h, format, type, data), touchAttached(state->readFrom))

#define WEFT_DEFINE(name, parameters, arguments, note)                 \
  decltype(glad_gl##name) traced##name = nullptr;                      \
  void GLAD_API_PTR trace##name parameters {                           \
    note;                                                              \
    traced##name arguments;                                            \
  }
WEFT_TRACED(WEFT_DEFINE)
#undef WEFT_DEFINE
// clang-format on

bool meet(const GlSpan& a, const GlSpan& b) {
  return a.object == b.object && a.begin < b.end && b.begin < a.end && a.layer < b.layer + b.layers &&
         b.layer < a.layer + a.layers;
}

struct Past {
  GlSpan span;
  std::uint32_t pass = 0;
  std::uint64_t time = 0;
};
using Pasts = std::map<std::uint64_t, std::vector<Past>>;  // by object

// The latest of each span says it all: what waits for that waits for the ones before.
void remember(Pasts& pasts, const GlEvent& event, std::uint64_t time) {
  std::vector<Past>& all = pasts[event.span.object];
  for (Past& past : all)
    if (past.span == event.span) {
      past = {event.span, event.pass, time};
      return;
    }
  all.push_back({event.span, event.pass, time});
}

}  // namespace

GlTrace::GlTrace() {
  assert(!state);
  state = new State;
#define WEFT_INSTALL(name, parameters, arguments, note) \
  traced##name = std::exchange(glad_gl##name, &trace##name);
  WEFT_TRACED(WEFT_INSTALL)
#undef WEFT_INSTALL
}

GlTrace::~GlTrace() {
#define WEFT_REMOVE(name, parameters, arguments, note) glad_gl##name = traced##name;
  WEFT_TRACED(WEFT_REMOVE)
#undef WEFT_REMOVE
  delete std::exchange(state, nullptr);
}

void GlTrace::beginFrame() {
  state->events.push_back({.kind = GlEvent::Kind::frame});
}
const std::vector<GlEvent>& GlTrace::events() const {
  return state->events;
}
const std::vector<std::string>& GlTrace::passes() const {
  return state->passes;
}

std::string GlTrace::nameOf(const GlSpan& span) const {
  const auto found = state->names.find(span.object);
  return fmt::format("'{}' [{}, {})", found == state->names.end() ? "?" : found->second, span.begin,
                     span.end);
}

std::string findHazard(const GlTrace& trace, const LeftOut& leftOut) {
  std::array<std::uint64_t, 32> last{};  // when each bit was issued
  Pasts stores, accesses;
  std::uint64_t time = 0;
  std::size_t barrier = kBeforeFrames;
  const auto isBehind = [&](const Past& past, GLbitfield bits) {
    for (; bits != 0; bits &= bits - 1)
      if (last[static_cast<std::size_t>(std::countr_zero(bits))] < past.time) return false;
    return true;
  };
  for (const GlEvent& event : trace.events()) {
    ++time;
    if (event.kind == GlEvent::Kind::frame) {
      barrier = 0;
    } else if (event.kind == GlEvent::Kind::barrier) {
      const GLbitfield bits = barrier++ == leftOut.barrier ? event.bits & ~leftOut.bit : event.bits;
      for (GLbitfield rest = bits; rest != 0; rest &= rest - 1)
        last[static_cast<std::size_t>(std::countr_zero(rest))] = time;
    } else {
      for (const Past& past : (event.store ? accesses : stores)[event.span.object])
        if (past.pass != event.pass && meet(past.span, event.span) && !isBehind(past, event.bits))
          return fmt::format("'{}' {} {} without the bits {:#x} since '{}'", trace.passes()[event.pass],
                             event.store ? "stores to" : "uses", trace.nameOf(event.span), event.bits,
                             trace.passes()[past.pass]);
      if (event.store) remember(stores, event, time);
      remember(accesses, event, time);
    }
  }
  return {};
}

}  // namespace weft::runtime::test
