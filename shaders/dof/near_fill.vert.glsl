// The tiles that near_fill.frag.glsl works on; parameters as there.
layout(std140) uniform Parameters {
  int tile;
  int largest;
  int rings;
};
#include "work.glsl"

void main() { gl_Position = workCorner(tile, 1); }
