// The graph's own names of the bits of glMemoryBarrier. Which access needs which is compile/barrier_rules.h; which GL enum
// each is stands in the runtime.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace weft::graph {

// One bit per glMemoryBarrier bit that a plan can need (OpenGL 4.5 core, 7.12.2); the runtime maps them.
enum BarrierBit : std::uint16_t {
  kBarrierVertex = 1 << 0,         // VERTEX_ATTRIB_ARRAY
  kBarrierIndex = 1 << 1,          // ELEMENT_ARRAY
  kBarrierUniform = 1 << 2,        // UNIFORM
  kBarrierTexture = 1 << 3,        // TEXTURE_FETCH
  kBarrierImage = 1 << 4,          // SHADER_IMAGE_ACCESS
  kBarrierCommand = 1 << 5,        // COMMAND
  kBarrierTextureUpdate = 1 << 6,  // TEXTURE_UPDATE: clears and sub-image writes
  kBarrierBufferUpdate = 1 << 7,   // BUFFER_UPDATE: buffer clears and copies
  kBarrierFramebuffer = 1 << 8,    // FRAMEBUFFER: attachments, blits, read-back of textures
  kBarrierStorage = 1 << 9,        // SHADER_STORAGE
};
constexpr int kBarrierBitCount = 10;
constexpr const char* barrierName(BarrierBit bit) {
  constexpr std::array<const char*, kBarrierBitCount> kNames = {
      "vertex",  "index",          "uniform",       "texture_fetch", "image_access",
      "command", "texture_update", "buffer_update", "framebuffer",   "shader_storage"};
  return kNames[static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(bit)))];
}

}  // namespace weft::graph
