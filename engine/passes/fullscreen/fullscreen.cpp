// One triangle over the whole target; the shader is a single .frag.glsl file.
#include "engine/passes/builtin.h"

namespace weft::passes {

namespace {

class Fullscreen final : public PassType {
 public:
  graph::PassType reflect() const override {
    return {
        .name = "fullscreen",
        .doc =
            "Runs a fragment shader once per pixel of what it writes. `in vec2 uv` is 0..1 from the lower "
            "left. Written slots are color attachments; `state` sets blending and the depth test.",
        .shader = graph::ShaderShape::fragment,
        .keys = {"raster", "samples", "state", "view", "feedback"}};
  }

  void execute(const PassContext&) const override { glDrawArrays(GL_TRIANGLES, 0, 3); }
};

}  // namespace

std::unique_ptr<PassType> makeFullscreen() {
  return std::make_unique<Fullscreen>();
}

}  // namespace weft::passes
