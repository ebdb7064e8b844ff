// Which glMemoryBarrier bit each kind of use needs (OpenGL 4.5 core, 7.12.2), as the compiler applies it. The
// oracle in the tests has a table of its own, written from the specification.
//
// Two rules make every barrier of a plan:
//  (a) Between an image or buffer store of a shader and a later use of the same physical sub-resource there must be the
//      bit of that use. A write in between changes nothing: its cadence may skip it, and it need not cover every texel.
//  (b) Between any access and a later image or buffer store to the same physical storage there must be
//      SHADER_IMAGE_ACCESS or SHADER_STORAGE, also when two resources only share that storage.
//
// The barriers are safe whichever passes run, and have no redundant bits when all passes run, with two exceptions in
// which safety wins. One is a history none of whose writers is `always`, read after a first writer that does not store
// and before a later one that does: a frame without writers then needs a bit that a frame with all of them does not.
// The other is what a time-sliced group writes: its copies change places at times that the plan does not know, so they
// count as one.
#pragma once

#include <cstdint>

#include "engine/graph/plan.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

// The bit a store itself waits behind, rule (b).
inline std::uint16_t storeBit(const FlatUse& use) {
  return use.kind == Kind::storage ? kBarrierStorage : kBarrierImage;
}

// The bits a use of a pass needs after an earlier store, rule (a). `copy` on a texture means framebuffer blits, an exact one
// glCopyImageSubData: the specification names no bit for that, and drivers move bytes, fetch or render, so it needs all three.
inline std::uint16_t useBits(const FlatUse& use, bool buffer) {
  switch (use.kind) {
    case Kind::sampled:
      return kBarrierTexture;
    case Kind::image:
      return kBarrierImage;
    case Kind::uniform:
      return kBarrierUniform;
    case Kind::storage:
      return kBarrierStorage;
    case Kind::indirect:
      return kBarrierCommand;
    case Kind::color:
    case Kind::depth:
      return use.feedback ? kBarrierFramebuffer | kBarrierTexture : kBarrierFramebuffer;
    case Kind::copy:
      if (buffer) return kBarrierBufferUpdate;
      return use.exact ? kBarrierFramebuffer | kBarrierTexture | kBarrierTextureUpdate : kBarrierFramebuffer;
  }
  return 0;
}

// glClearNamedFramebuffer of an attachment; glClearTexSubImage, glClearNamedBufferSubData
inline std::uint16_t clearBit(const ClearOp& clear, bool buffer) {
  return clear.attachment != kNone ? kBarrierFramebuffer
         : buffer                  ? kBarrierBufferUpdate
                                   : kBarrierTextureUpdate;
}

// What follows the last step: the present blit and glReadPixels, and a buffer is copied out.
inline std::uint16_t endBits(bool buffer) {
  return buffer ? kBarrierBufferUpdate : kBarrierFramebuffer;
}

}  // namespace weft::graph
