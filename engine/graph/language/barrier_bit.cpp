#include "engine/graph/language/barrier_bit.h"

namespace weft::graph {

const char* barrierName(BarrierBit bit) {
  switch (bit) {
    case kBarrierVertex:
      return "vertex";
    case kBarrierIndex:
      return "index";
    case kBarrierUniform:
      return "uniform";
    case kBarrierTexture:
      return "texture_fetch";
    case kBarrierImage:
      return "image_access";
    case kBarrierCommand:
      return "command";
    case kBarrierTextureUpdate:
      return "texture_update";
    case kBarrierBufferUpdate:
      return "buffer_update";
    case kBarrierFramebuffer:
      return "framebuffer";
    case kBarrierStorage:
      return "shader_storage";
  }
  return "";
}

}  // namespace weft::graph
