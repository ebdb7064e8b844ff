// The tiles that near_bokeh.frag.glsl works on; parameters as there.
layout(std140) uniform Parameters {
  int rings;
  int blades;
  int tile;
  int largest;
};
#include "work.glsl"

void main() { gl_Position = workCorner(tile, 1); }
