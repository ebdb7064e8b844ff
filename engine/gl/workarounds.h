// Everything this room does because of how drivers behave rather than because of what OpenGL says, each with
// a name, a reason and the date it was last seen; the code it causes names it. Remove an entry by undoing it
// and watching the tests.
#pragma once

#include "engine/gl/context.h"

namespace weft::gl::workarounds {

// timer-queries-lie: llvmpipe counts submission, not execution: a 250 ms draw reads 1 ms. Profile such
// devices with the wall clock between glFinish. Mesa 22.3.6, 2026-11-21.
inline bool timerQueriesLie(const DeviceInfo& device) {
  return device.software;
}

// binaries-per-backend: EGL and OSMesa give identical GL_VERSION and GL_RENDERER strings and reject each
// other's program binaries, so the backend is part of every cache key. Mesa 22.3.6, 2026-11-21.

// stencil-view: viewing stencil as R8UI (or D32F as R32F) is invalid everywhere (they are classes of their
// own), so a stencil view has the same format and DEPTH_STENCIL_TEXTURE_MODE set to STENCIL_INDEX.
// OpenGL 4.5 8.18, 2026-11-21.

// view-names-from-gen: glTextureView wants a name that has never been bound; glCreateTextures binds.
// OpenGL 4.5 8.18, enforced by Mesa 22.3.6, 2026-11-21.

// source-numbers-lost: Mesa's log has source string 0 for expressions, whatever #line said (its parser's
// YYLLOC_DEFAULT resets it), and the right line; so lines are numbered through the whole text
// (shader_source.h). Mesa 22.3.6, 2026-11-21.

// columns-after-preprocessing: Mesa counts the columns of its log in preprocessed text, where a run of blanks
// is one; mapLog counts back (in lines without macros). NVIDIA gives no columns. Mesa 22.3.6, 2026-11-21.

// storage-flag-without-storage: after glNamedBufferStorage ran out of memory Mesa still answers GL_TRUE for
// GL_BUFFER_IMMUTABLE_STORAGE (for textures the flag is true to fact), so Buffer asks glGetError.
// Mesa 22.3.6, 2026-11-21.

// compiler-messages-twice: Mesa sends every line of a shader's log, warnings included, as a KHR_debug message
// of high severity besides the log that Program reads and maps. Messages of the shader compiler of type error
// or other are therefore switched off; its performance messages stay. Mesa 22.3.6, 2026-11-21.

}  // namespace weft::gl::workarounds
