// Copies, and scales, one texture level to another with the fixed-function blit.
#include "engine/passes/builtin.h"

namespace weft::passes {

std::unique_ptr<PassType> makeBlit() {
  graph::PassType reflected = {
      .name = "blit",
      .doc =
          "Copies `source` to `destination`: one level and layer of a texture, scaling when the sizes "
          "differ (`\"source\": \"x as linear\"` filters), or a buffer to one of the same size.",
      .shader = graph::ShaderShape::none,
      .defaultReadTexture = graph::Kind::copy,
      .defaultWriteTexture = graph::Kind::copy,
      .fixedSlots = {{"source", graph::Access::read, "the level and layer, or the buffer, to copy from",
                      graph::FixedSlot::Takes::either},
                     {"destination", graph::Access::write, "the level and layer, or the buffer, to copy to",
                      graph::FixedSlot::Takes::either}},
      .framebuffers = true};
  return std::make_unique<BuiltinPass>(std::move(reflected), [](const PassContext& context) {
    if (const BoundBuffer& from = context.sourceBuffer, &to = context.destinationBuffer;
        from.name && to.name) {
      glCopyNamedBufferSubData(from.name, to.name, from.offset, to.offset, to.bytes);
      return;
    }
    const BoundTexture &from = context.source, &to = context.destination;
    const bool linear = context.linear && from.planes == GL_COLOR_BUFFER_BIT;
    glBlitNamedFramebuffer(from.framebuffer, to.framebuffer, 0, 0, static_cast<GLint>(from.width),
                           static_cast<GLint>(from.height), 0, 0, static_cast<GLint>(to.width),
                           static_cast<GLint>(to.height), from.planes & to.planes,
                           linear ? GL_LINEAR : GL_NEAREST);
  });
}

}  // namespace weft::passes
