// The tiles of far_field.frag.glsl with NEAR, at the depth from which the far field can be visible; parameters as there.
#include "far_field.glsl"
#include "coc.glsl"
#include "work.glsl"

uniform sampler2D blurred;
layout(std140) uniform Parameters {
  float infinity;
  float focus;
  int tile;
};
noperspective out vec2 at, at_half;
flat out vec2 lens;

void main() {
  gl_Position = workCorner(tile, SCALE, false);
  at = gl_Position.xy * 0.5 + 0.5;
  at_half = at * viewport / float(SCALE) / vec2(textureSize(blurred, 0));
  lens = vec2(infinity, infinity * focus / near_plane);
  gl_Position.z = min(cocDepth(-kNearStart, infinity, focus), 1.0);
}
