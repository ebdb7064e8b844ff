#include "engine/passes/draw/draw.h"

namespace weft::passes {

graph::PassType Draw::reflect() const {
  return {.name = "draw",
          .doc =
              "Draws the instances of `list` (or `instances` copies) as `geometry`, seen from `view`, with "
              "NAME.vert.glsl and "
              "NAME.frag.glsl, or the two that `shader` names. Written slots are attachments; a depth format "
              "is the depth attachment.",
          .shader = graph::ShaderShape::draw,
          .keys = {"list", "geometry", "instances", "view", "state", "feedback"}};
}

void Draw::execute(const PassContext& context) const {
  const Geometry& geometry = context.geometry;
  if (context.instances == 0 || geometry.count == 0) return;
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
}

}  // namespace weft::passes
