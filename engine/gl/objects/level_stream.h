// Makes the levels of a 2D texture below its first, a portion at a time, each from the level above it: so
// that no frame waits for the levels of a large map. Big levels of powers of two are made by rows, as
// the average of four texels, to the bit what llvmpipe makes of them; others one per portion, and small ones
// all at once, by the driver. Does not: own the texture, wait, or know when the GPU is done with a portion.
#pragma once

#include "engine/gl/objects/objects.h"

namespace weft::gl {

class LevelStream {
 public:
  // Level 0 of `texture` is whole. `texelsPerPortion` at least 1.
  LevelStream(const TextureRef& texture, std::uint32_t texelsPerPortion)
      : texture_(texture), texelsPerPortion_(texelsPerPortion) {}

  // Makes the next portion. False after W115.
  bool advance(base::Diagnostics& diagnostics);
  bool madeAll() const { return level_ >= texture_.desc.mips; }
  // The share of the texels below level 0 that are made, 0 to 1.
  float done() const;

 private:
  void makeLevels(std::uint32_t last);
  TextureRef texture_;
  std::uint32_t texelsPerPortion_ = 1;
  std::uint32_t level_ = 1, row_ = 0;  // the next to make
  Framebuffer from_, to_;              // of the level that is made by rows
};

}  // namespace weft::gl
