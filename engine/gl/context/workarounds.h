// Everything this room does because of how drivers behave rather than because of what OpenGL says, each with
// a name, a reason and the date it was last seen; the code it causes names it. Remove an entry by undoing it
// and watching the tests.
#pragma once

// cache-on-a-full-disk: Mesa maps the index of its shader cache, a file of 1.3 MB with holes, into memory: where the disk is full the
// process ends with SIGBUS. So the cache is switched off where there is little room. Mesa 22.3.6, 2026-11-26.

// timer-queries-lie: llvmpipe counts submission, not execution: a 250 ms draw reads 1 ms. Profile such
// devices with the wall clock between glFinish. Mesa 22.3.6, 2026-11-21.

// binaries-per-backend: EGL and OSMesa give identical GL_VERSION and GL_RENDERER strings and reject each
// other's program binaries, so the backend is part of every cache key. Mesa 22.3.6, 2026-11-21.

// stencil-view: viewing stencil as R8UI (or D32F as R32F) is invalid everywhere (they are classes of their
// own), so a stencil view has the same format and DEPTH_STENCIL_TEXTURE_MODE set to STENCIL_INDEX.
// OpenGL 4.5 8.18, 2026-11-21.

// view-names-from-gen: glTextureView wants a name that has never been bound; glCreateTextures binds.
// OpenGL 4.5 8.18, enforced by Mesa 22.3.6, 2026-11-21.

// source-numbers-lost: Mesa's log names source string 0 for some expressions whatever #line said, beside the
// right line (seen; the cause was not looked for); so lines are numbered through the whole text
// (glsl/source.h). Mesa 22.3.6, 2026-11-21.

// columns-after-preprocessing: the columns of Mesa's log count a run of blanks as one (seen on lines with and
// without such runs), as its preprocessor would leave them; mapLog counts back, in lines without macros.
// Mesa 22.3.6, 2026-11-21.

// storage-flag-without-storage: after glNamedBufferStorage ran out of memory Mesa still answers GL_TRUE for
// GL_BUFFER_IMMUTABLE_STORAGE (for textures the flag is true to fact), so Buffer asks glGetError.
// Mesa 22.3.6, 2026-11-21.

// copies-between-formats-draw: Mesa does glCopyImageSubData by moving bytes where both textures have one format, and
// else by drawing, whatever formats their views have: 1.0 ms against 0.10 ms for rgba8 of 640x360 on llvmpipe. Nothing is
// done for it here: every plan gives both textures of an exact copy the format that is copied, if it can
// (graph/compile/storage.cpp). Mesa 22.3.6, 2026-11-23.

// compiler-messages-twice: Mesa sends every error of a shader's log also as a KHR_debug message of the shader
// compiler (type error, above notification), besides the log that Program reads and maps, so those are off.
// Mesa 22.3.6, 2026-11-21.

// stale-textures-at-clears: NVIDIA's driver warns at a clear of the program in use whose textures are deleted, so a
// step binds before it clears (runtime/frame/step_runner.cpp). 580.159, 2026-11-26.
