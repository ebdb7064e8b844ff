// The tiles of the far field whose discs differ, at the depth from which the picture is blurred.
// read    tiles    from far_tiles
// params  infinity, focus   as in split
// defines EVEN     default 0; 1: the tiles whose discs are alike
#include "coc.glsl"
#include "far_tiles/work.glsl"

#ifndef EVEN
#define EVEN 0
#endif

uniform sampler2D blurred, tiles;
layout(std140) uniform Parameters {
  float infinity;
  float focus;
};
noperspective out vec2 at, at_half;

void main() {
  gl_Position = farCorner(tiles, SCALE, EVEN == 1);
  at = gl_Position.xy * 0.5 + 0.5;
  at_half = at * viewport / float(SCALE) / vec2(textureSize(blurred, 0));
  gl_Position.z = cocDepth(kSmall, infinity, focus);
}
