// A triangle over the picture at the depth from which the picture is blurred.
#include "coc.glsl"

uniform sampler2D blurred;
layout(std140) uniform Parameters {
  float infinity;
  float focus;
};
noperspective out vec2 at, at_half;
flat out vec2 lens;

void main() {
  at = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  at_half = at * viewport / float(SCALE) / vec2(textureSize(blurred, 0));
  lens = vec2(infinity, infinity * focus / near_plane);
  gl_Position = vec4(at * 2.0 - 1.0, cocDepth(0.5, infinity, focus), 1.0);
}
