#include "engine/passes/fullscreen/fullscreen.h"

namespace weft::passes {

graph::PassType Fullscreen::reflect() const {
  return {.name = "fullscreen",
          .doc =
              "Runs a fragment shader once per pixel of what it writes. `in vec2 uv` is 0..1 from the lower "
              "left. Written "
              "slots are colour attachments; `state` sets blending and the depth test.",
          .shader = graph::ShaderShape::fragment,
          .keys = {"state", "view", "feedback"}};
}

void Fullscreen::execute(const PassContext&) const {
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace weft::passes
