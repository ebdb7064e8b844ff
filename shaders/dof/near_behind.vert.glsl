// The tiles that near_behind.frag.glsl works on, at the depth from which on something behind can show; parameters as there.
#define NEAR 1
#include "behind.glsl"
#include "work.glsl"

void main() {
  gl_Position = workCorner(tile, 2);
  gl_Position.z = min(cocDepth(-kNearStart, infinity, focus), 1.0);
}
