// A triangle over the picture at the depth from which on the sharp picture is not enough.
#define NEAR 0
#include "behind.glsl"

void main() {
  vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  gl_Position = vec4(corner * 2.0 - 1.0, cocDepth(0.5, infinity, focus), 1.0);
}
