#include "engine/passes/compute/compute.h"

#include <algorithm>

namespace weft::passes {

graph::PassType Compute::reflect() const {
  return {.name = "compute",
          .doc = "Runs a compute shader over `threads` invocations (a number or a list of up to three; default the size of "
                 "the first written texture), rounded up to the shader's local size. Written textures are images, buffers storage.",
          .shader = graph::ShaderShape::compute,
          .defaultWriteTexture = graph::Kind::image,
          .keys = {"threads", "view"}};
}

void Compute::execute(const PassContext& context) const {
  GLuint groups[3];
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t size = std::max(1u, context.groupSize[axis]);
    groups[axis] = (context.spec->threads[axis] + size - 1) / size;
    if (groups[axis] == 0) return;
  }
  // Long one-dimensional work may need more groups than one axis allows: fold it into rows. A shader that supports it
  // computes its index from gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x and checks its range.
  if (groups[0] > context.maxGroups[0] && groups[1] == 1) {
    groups[1] = (groups[0] + context.maxGroups[0] - 1) / context.maxGroups[0];
    groups[0] = context.maxGroups[0];
  }
  glDispatchCompute(groups[0], groups[1], groups[2]);
}

}  // namespace weft::passes
