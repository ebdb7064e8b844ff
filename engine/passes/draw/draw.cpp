// Instanced geometry: a draw list of the scene, or `instances` copies of a built-in shape.
#include "engine/passes/builtin.h"

namespace weft::passes {

std::unique_ptr<PassType> makeDraw() {
  graph::PassType reflected = {
      .name = "draw",
      .doc =
          "Draws the instances of `list` (or `instances` copies, or what a buffer `as indirect` says) as "
          "`geometry`, seen from `view`, with "
          "NAME.vert.glsl and NAME.frag.glsl, or the two that `shader` names. Written slots are "
          "attachments; a depth format is the depth attachment.",
      .shader = graph::ShaderShape::draw,
      .keys = {"list", "geometry", "instances", "draws", "raster", "samples", "view", "state", "feedback"},
      .indirect = true};
  return std::make_unique<BuiltinPass>(std::move(reflected), [](const PassContext& context) {
    const Geometry& geometry = context.geometry;
    if (context.instances == 0) return;
    if (const BoundBuffer& commands = context.commands; commands.name) {
      const void* const at = reinterpret_cast<const void*>(commands.offset);
      const auto draws = static_cast<GLsizei>(context.spec->draws);
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.name);
      if (geometry.indexType)
        glMultiDrawElementsIndirect(geometry.mode, geometry.indexType, at, draws, 0);
      else
        glMultiDrawArraysIndirect(geometry.mode, at, draws, 0);
      return;
    }
    if (geometry.count == 0) return;
    if (geometry.commands) {
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, geometry.commands);
      glMultiDrawElementsIndirect(geometry.mode, geometry.indexType, nullptr, geometry.count, 0);
      return;
    }
    const auto instances = static_cast<GLsizei>(context.instances);
    if (geometry.indexType)
      glDrawElementsInstanced(geometry.mode, geometry.count, geometry.indexType, nullptr, instances);
    else
      glDrawArraysInstanced(geometry.mode, 0, geometry.count, instances);
  });
}

}  // namespace weft::passes
