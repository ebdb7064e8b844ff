// Gathers what gather.frag.glsl reads often into two textures: a copy of the picture, and the streak and depth of each pixel. In the tiles
// that streaks.vert.glsl picks.
// read    source, velocity, depth   radiance, screen UV per frame, reversed-Z; all nearest
// write   still     the radiance, scene-referred
//         streaks   half the path while the shutter is open, in pixels; 0; depth
// params  shutter, tile   as in gather.frag.glsl
#include "common/finite.glsl"
#include "blur.glsl"

uniform sampler2D source, velocity, depth;
layout(std140) uniform Parameters {
  float shutter;
  int tile;
};
out vec4 still;
out vec4 streaks;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 own = texelFetch(source, pixel, 0);
  still = vec4(finite(own.rgb), own.a);
  streaks = vec4(streakOf(texelFetch(velocity, pixel, 0).rg, vec2(textureSize(source, 0)), shutter, tile), 0.0,
                 texelFetch(depth, pixel, 0).r);
}
