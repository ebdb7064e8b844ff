#include "tests/runtime/gl_recorder.h"

#include <cassert>
#include <utility>

namespace weft::runtime::test {

namespace {

using Recording = std::vector<GlCall>;
Recording* recording = nullptr;

PFNGLMEMORYBARRIERPROC realBarrier = nullptr;
PFNGLTEXTUREBARRIERPROC realTextureBarrier = nullptr;
PFNGLPUSHDEBUGGROUPPROC realPush = nullptr;
PFNGLPOPDEBUGGROUPPROC realPop = nullptr;
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
  realBarrier = std::exchange(glad_glMemoryBarrier, &recordBarrier);
  realTextureBarrier = std::exchange(glad_glTextureBarrier, &recordTextureBarrier);
  realPush = std::exchange(glad_glPushDebugGroup, &recordPush);
  realPop = std::exchange(glad_glPopDebugGroup, &recordPop);
  realBlit = std::exchange(glad_glBlitNamedFramebuffer, &recordBlit);
  realCopyImage = std::exchange(glad_glCopyImageSubData, &recordCopyImage);
}

GlRecorder::~GlRecorder() {
  glad_glMemoryBarrier = realBarrier;
  glad_glTextureBarrier = realTextureBarrier;
  glad_glPushDebugGroup = realPush;
  glad_glPopDebugGroup = realPop;
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
