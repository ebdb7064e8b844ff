// behind.frag.glsl before the focus, drawn in tiles: a draw names its two shaders alike.
#define NEAR 1
#include "behind.frag.glsl"
