#include "tests/runtime/gl_recorder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cassert>
#include <utility>

#include "engine/gl/context/debug.h"

namespace weft::runtime::test {

namespace {

using Recording = std::vector<GlCall>;
Recording* recording = nullptr;

// The state `key` is set to `value`.
void note(const std::string& key, const std::string& value) {
  recording->push_back({.name = key, .value = value});
}

// One entry of glad's table: what it was, and a function that records how many leading arguments name the state.
// (clang-format never settles on where the backslashes go.)
// clang-format off
#define WEFT_RECORDED(X)                                                                            \
  X(UseProgram, 0) X(BindTextureUnit, 1) X(BindSampler, 1) X(BindImageTexture, 1)                   \
  X(BindBuffer, 1)                                                                                  \
  X(BindBufferBase, 2) X(BindBufferRange, 2) X(BindVertexArray, 0) X(Viewport, 0) X(Scissor, 0)     \
  X(DepthFunc, 0) X(DepthMask, 0) X(ColorMask, 0) X(ColorMaski, 1) X(StencilMask, 0) X(CullFace, 0) \
  X(PolygonMode, 0) X(PolygonOffset, 0) X(BlendEquationi, 1) X(BlendFuncSeparatei, 1)               \
  X(BlendFunci, 1) X(BlendColor, 0)
// clang-format on

template <std::size_t keys, class... Arguments>
void noteCall(const char* name, Arguments... arguments) {
  std::string key = name, value;
  std::size_t at = 0;
  ((at++ < keys ? key += fmt::format(" {}", arguments) : value += fmt::format("{} ", arguments)), ...);
  note(key, value);
}

// A buffer bound whole or in part is one state.
template <>
void noteCall<2, GLenum, GLuint, GLuint>(const char*, GLenum target, GLuint index, GLuint buffer) {
  note(fmt::format("buffer {} {}", target, index), fmt::format("{} whole", buffer));
}
template <>
void noteCall<2, GLenum, GLuint, GLuint, GLintptr, GLsizeiptr>(const char*, GLenum target, GLuint index,
                                                               GLuint buffer, GLintptr offset,
                                                               GLsizeiptr size) {
  note(fmt::format("buffer {} {}", target, index), fmt::format("{} {} {}", buffer, offset, size));
}

// The mask of one color target: the one of all is another from then on.
template <>
void noteCall<1, GLuint, GLboolean, GLboolean, GLboolean, GLboolean>(const char*, GLuint target, GLboolean r,
                                                                     GLboolean g, GLboolean b, GLboolean a) {
  note("glColorMask", fmt::format("{} alone: {} {} {} {}", target, r, g, b, a));
}

template <class F>
struct Hook;
template <class... Arguments>
struct Hook<void(GLAD_API_PTR*)(Arguments...)> {
  template <int id>
  struct At {
    static inline void(GLAD_API_PTR* real)(Arguments...) = nullptr;
    static inline const char* name = nullptr;
    template <std::size_t keys>
    static void GLAD_API_PTR call(Arguments... arguments) {
      noteCall<keys, Arguments...>(name, arguments...);
      real(arguments...);
    }
  };
};

template <int id, std::size_t keys, class F>
void replace(F& entry, const char* name) {
  using Here = typename Hook<F>::template At<id>;
  assert(entry);
  Here::real = entry;
  Here::name = name;
  entry = &Here::template call<keys>;
}
template <int id, class F>
void restore(F& entry) {
  entry = Hook<F>::template At<id>::real;
}

enum Id : int {
#define WEFT_ID(name, keys) k##name,
  WEFT_RECORDED(WEFT_ID)
#undef WEFT_ID
};

PFNGLMEMORYBARRIERPROC realBarrier = nullptr;
PFNGLTEXTUREBARRIERPROC realTextureBarrier = nullptr;
PFNGLPUSHDEBUGGROUPPROC realPush = nullptr;
PFNGLPOPDEBUGGROUPPROC realPop = nullptr;
PFNGLENABLEPROC realEnable = nullptr, realDisable = nullptr;
PFNGLENABLEIPROC realEnablei = nullptr, realDisablei = nullptr;
PFNGLBINDFRAMEBUFFERPROC realBindFramebuffer = nullptr;
PFNGLBLITNAMEDFRAMEBUFFERPROC realBlit = nullptr;
PFNGLCOPYIMAGESUBDATAPROC realCopyImage = nullptr;

void GLAD_API_PTR recordBarrier(GLbitfield bits) {
  recording->push_back({.kind = GlCall::Kind::barrier, .bits = bits});
  realBarrier(bits);
}
void GLAD_API_PTR recordTextureBarrier() {
  recording->push_back({.kind = GlCall::Kind::texture_barrier});
  realTextureBarrier();
}
void GLAD_API_PTR recordPush(GLenum source, GLuint id, GLsizei length, const GLchar* message) {
  const std::string name = length < 0 ? message : std::string(message, static_cast<std::size_t>(length));
  recording->push_back({.kind = GlCall::Kind::group, .name = name});
  realPush(source, id, length, message);
}
void GLAD_API_PTR recordPop() {
  recording->push_back({.kind = GlCall::Kind::group_end});
  realPop();
}
void GLAD_API_PTR recordEnable(GLenum capability) {
  note(fmt::format("capability {:#x}", capability), "on");
  realEnable(capability);
}
void GLAD_API_PTR recordDisable(GLenum capability) {
  note(fmt::format("capability {:#x}", capability), "off");
  realDisable(capability);
}
void GLAD_API_PTR recordEnablei(GLenum capability, GLuint index) {
  note(fmt::format("capability {:#x} of {}", capability, index), "on");
  realEnablei(capability, index);
}
void GLAD_API_PTR recordDisablei(GLenum capability, GLuint index) {
  note(fmt::format("capability {:#x} of {}", capability, index), "off");
  realDisablei(capability, index);
}
// GL_FRAMEBUFFER is both; read-back binds the one for reading.
void GLAD_API_PTR recordBindFramebuffer(GLenum target, GLuint framebuffer) {
  const std::string value = fmt::format("{}", framebuffer);
  if (target == GL_FRAMEBUFFER) {
    recording->push_back({.name = "glBindFramebuffer read", .value = value, .bySideEffect = true});
    note("glBindFramebuffer draw", value);
  } else {
    note(target == GL_READ_FRAMEBUFFER ? "glBindFramebuffer read" : "glBindFramebuffer draw", value);
  }
  realBindFramebuffer(target, framebuffer);
}

void GLAD_API_PTR recordBlit(GLuint from, GLuint to, GLint x0, GLint y0, GLint x1, GLint y1, GLint u0,
                             GLint v0, GLint u1, GLint v1, GLbitfield planes, GLenum filter) {
  recording->push_back({.kind = GlCall::Kind::copy, .name = "glBlitNamedFramebuffer"});
  realBlit(from, to, x0, y0, x1, y1, u0, v0, u1, v1, planes, filter);
}
void GLAD_API_PTR recordCopyImage(GLuint from, GLenum fromTarget, GLint fromLevel, GLint x, GLint y, GLint z,
                                  GLuint to, GLenum toTarget, GLint toLevel, GLint u, GLint v, GLint w,
                                  GLsizei width, GLsizei height, GLsizei depth) {
  recording->push_back({.kind = GlCall::Kind::copy, .name = "glCopyImageSubData"});
  realCopyImage(from, fromTarget, fromLevel, x, y, z, to, toTarget, toLevel, u, v, w, width, height, depth);
}

}  // namespace

GlRecorder::GlRecorder() {
  assert(!recording);
  recording = new Recording;
#define WEFT_REPLACE(name, keys) replace<k##name, keys>(glad_gl##name, "gl" #name);
  WEFT_RECORDED(WEFT_REPLACE)
#undef WEFT_REPLACE
  realBarrier = std::exchange(glad_glMemoryBarrier, &recordBarrier);
  realTextureBarrier = std::exchange(glad_glTextureBarrier, &recordTextureBarrier);
  realPush = std::exchange(glad_glPushDebugGroup, &recordPush);
  realPop = std::exchange(glad_glPopDebugGroup, &recordPop);
  realEnable = std::exchange(glad_glEnable, &recordEnable);
  realDisable = std::exchange(glad_glDisable, &recordDisable);
  realEnablei = std::exchange(glad_glEnablei, &recordEnablei);
  realDisablei = std::exchange(glad_glDisablei, &recordDisablei);
  realBindFramebuffer = std::exchange(glad_glBindFramebuffer, &recordBindFramebuffer);
  realBlit = std::exchange(glad_glBlitNamedFramebuffer, &recordBlit);
  realCopyImage = std::exchange(glad_glCopyImageSubData, &recordCopyImage);
}

GlRecorder::~GlRecorder() {
#define WEFT_RESTORE(name, keys) restore<k##name>(glad_gl##name);
  WEFT_RECORDED(WEFT_RESTORE)
#undef WEFT_RESTORE
  glad_glMemoryBarrier = realBarrier;
  glad_glTextureBarrier = realTextureBarrier;
  glad_glPushDebugGroup = realPush;
  glad_glPopDebugGroup = realPop;
  glad_glEnable = realEnable;
  glad_glDisable = realDisable;
  glad_glEnablei = realEnablei;
  glad_glDisablei = realDisablei;
  glad_glBindFramebuffer = realBindFramebuffer;
  glad_glBlitNamedFramebuffer = realBlit;
  glad_glCopyImageSubData = realCopyImage;
  delete std::exchange(recording, nullptr);
}

void GlRecorder::start() {
  recording->clear();
}
const std::vector<GlCall>& GlRecorder::calls() const {
  return *recording;
}

}  // namespace weft::runtime::test
