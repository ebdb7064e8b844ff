#include "engine/passes/compute/compute.h"

#include "engine/passes/compute/work_groups.h"

namespace weft::passes {

graph::PassType Compute::reflect() const {
  return {.name = "compute",
          .doc =
              "Runs a compute shader over `threads` invocations (a number or a list of up to three; default "
              "the size of "
              "the first written texture), rounded up to the shader's local size. Written textures are "
              "images, buffers storage.",
          .shader = graph::ShaderShape::compute,
          .defaultWriteTexture = graph::Kind::image,
          .keys = {"threads", "view"}};
}

void Compute::execute(const PassContext& context) const {
  const WorkGroups groups = workGroupsOf(context);
  if (groups.count[0] == 0 || groups.count[1] == 0 || groups.count[2] == 0) return;
  glDispatchCompute(groups.count[0], groups.count[1], groups.count[2]);
}

}  // namespace weft::passes
