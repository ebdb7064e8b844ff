// A dispatch of `threads` invocations, rounded up to the program's local size.
#include "engine/passes/builtin.h"
#include "engine/passes/compute/work_groups.h"

namespace weft::passes {

std::unique_ptr<PassType> makeCompute() {
  graph::PassType reflected = {
      .name = "compute",
      .doc =
          "Runs a compute shader over `threads` invocations (a number or a list of up to three; default "
          "the size of the first written texture), rounded up to the shader's local size, or over the "
          "groups that a buffer `as indirect` says. Written "
          "textures are images, buffers storage.",
      .shader = graph::ShaderShape::compute,
      .defaultWriteTexture = graph::Kind::image,
      .keys = {"threads", "view"},
      .indirect = true};
  return std::make_unique<BuiltinPass>(std::move(reflected), [](const PassContext& context) {
    if (const BoundBuffer& commands = context.commands; commands.name) {
      glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, commands.name);
      glDispatchComputeIndirect(commands.offset);
      return;
    }
    const WorkGroups groups = workGroupsOf(context);
    if (groups.count[0] == 0 || groups.count[1] == 0 || groups.count[2] == 0) return;
    glDispatchCompute(groups.count[0], groups.count[1], groups.count[2]);
  });
}

}  // namespace weft::passes
