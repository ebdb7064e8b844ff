// fill.frag.glsl for the layer before the focus, drawn in tiles: a draw names its two shaders alike.
#define NEAR 1
#include "fill.frag.glsl"
