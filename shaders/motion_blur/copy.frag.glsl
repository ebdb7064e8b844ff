// Copies the picture, which gather.frag.glsl overwrites, in the tiles that copy.vert.glsl picks.
// read    source   radiance, nearest
// write   red_green, blue_alpha   the same, finite
#include "common/finite.glsl"

uniform sampler2D source;
out vec2 red_green;
out vec2 blue_alpha;

void main() {
  vec4 own = texelFetch(source, ivec2(gl_FragCoord.xy), 0);
  vec3 light = finite(own.rgb);
  red_green = light.rg;
  blue_alpha = vec2(light.b, own.a);
}
