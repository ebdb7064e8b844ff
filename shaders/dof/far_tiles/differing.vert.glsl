// The tiles of the far field whose discs differ, at the depth that split gives to what far_bokeh has to do.
// read    tiles    from find.comp.glsl
// defines WIDER    default 0; 1: a texel wider on each side, for what lies between two tiles
#include "dof/idle.glsl"
#include "work.glsl"

#ifndef WIDER
#define WIDER 0
#endif

uniform sampler2D tiles;

void main() {
  gl_Position = farCorner(tiles, 1, false);
  gl_Position.z = kBusy;
  bool wanted = texelFetch(tiles, tileOf(textureSize(tiles, 0)), 0).r < 0.0;
  if (wanted) gl_Position.xy += (vec2(gl_VertexID & 1, gl_VertexID >> 1) - 0.5) * (4.0 * float(WIDER) / viewport);
}
