// The tiles of far_field.frag.glsl beside the near field, at the depth from which the far field can be visible; parameters as there.
#include "coc.glsl"
#include "work.glsl"

uniform sampler2D blurred;
layout(std140) uniform Parameters {
  float infinity;
  float focus;
  int tile;
};
noperspective out vec2 at, at_half;

void main() {
  gl_Position = workCorner(tile, SCALE, false);
  at = gl_Position.xy * 0.5 + 0.5;
  at_half = at * viewport / float(SCALE) / vec2(textureSize(blurred, 0));
  gl_Position.z = min(cocDepth(-kSmall, infinity, focus), 1.0);
}
