// The tiles that before.frag.glsl works on.
// params  tile     as in work.glsl
layout(std140) uniform Parameters { int tile; };
#include "work.glsl"

void main() { gl_Position = workCorner(tile, 2); }
