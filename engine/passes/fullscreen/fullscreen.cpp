// One triangle over the whole target; the shader is a single .frag.glsl file.
#include "engine/passes/builtin.h"

namespace weft::passes {

std::unique_ptr<PassType> makeFullscreen() {
  graph::PassType reflected = {
      .name = "fullscreen",
      .doc =
          "Runs a fragment shader once per pixel of what it writes. `in vec2 uv` is 0..1 from the lower "
          "left. Written slots are color attachments; `state` sets blending and the depth test.",
      .shader = graph::ShaderShape::fragment,
      .keys = {"raster", "samples", "state", "view", "feedback"}};
  return std::make_unique<BuiltinPass>(std::move(reflected),
                                       [](const PassContext&) { glDrawArrays(GL_TRIANGLES, 0, 3); });
}

}  // namespace weft::passes
