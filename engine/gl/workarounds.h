// Everything this room does because of how drivers behave rather than because of what OpenGL says, each with a name,
// a reason and the date it was last seen. Remove an entry by deleting it and watching the tests.
#pragma once

#include "engine/gl/context.h"

namespace weft::gl::workarounds {

// timer-queries-lie: llvmpipe counts submission, not execution: a 250 ms draw reads 1 ms. Profile such devices with the
// wall clock between glFinish. Mesa 22.3.6, 2026-11-21.
inline bool timerQueriesLie(const DeviceInfo& device) { return device.software; }

// binaries-per-backend: EGL and OSMesa give identical GL_VERSION and GL_RENDERER strings and reject each other's program
// binaries, so the backend is part of every cache key. Mesa 22.3.6, 2026-11-21.
constexpr bool kBackendInProgramKey = true;

// stencil-view: viewing stencil as R8UI (or D32F as R32F) is invalid everywhere (they are classes of their own), so a
// stencil view has the same format and DEPTH_STENCIL_TEXTURE_MODE set to STENCIL_INDEX. OpenGL 4.5 8.18, 2026-11-21.
constexpr bool kStencilViewsKeepFormat = true;

// view-names-from-gen: glTextureView wants a name that has never been bound; glCreateTextures binds. OpenGL 4.5 8.18,
// enforced by Mesa 22.3.6, 2026-11-21.
constexpr bool kViewNamesFromGenTextures = true;

}  // namespace weft::gl::workarounds
