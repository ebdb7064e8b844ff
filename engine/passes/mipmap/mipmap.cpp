// Box-filters the levels below `source` with glGenerateTextureMipmap.
#include "engine/passes/builtin.h"

namespace weft::passes {

std::unique_ptr<PassType> makeMipmap() {
  graph::PassType reflected = {
      .name = "mipmap",
      .doc =
          "Fills the levels of `result` from the level `source` above them: `\"source\": \"x.mip[0]\"`, "
          "`\"result\": \"x.mip[1..]\"`. Both name the same texture and the levels follow each other.",
      .shader = graph::ShaderShape::none,
      .defaultReadTexture = graph::Kind::copy,
      .defaultWriteTexture = graph::Kind::copy,
      .fixedSlots = {{"source", graph::Access::read, "the finest level, already written"},
                     {"result", graph::Access::write, "the levels below it"}},
      .fromSource = true,
      // The specification names no bit for glGenerateTextureMipmap. Drivers fetch, render or copy, so it needs all three bits.
      .touches = graph::kBarrierFramebuffer | graph::kBarrierTexture | graph::kBarrierTextureUpdate};
  // The executor hands over one view that starts at the source level and ends at the last level written.
  return std::make_unique<BuiltinPass>(std::move(reflected), [](const PassContext& context) {
    glGenerateTextureMipmap(context.destination.name);
  });
}

}  // namespace weft::passes
