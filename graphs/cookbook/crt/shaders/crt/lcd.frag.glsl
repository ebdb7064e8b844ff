// What the crystals show: one of four shades by an ordered dither (Bayer 1973), which they approach with time.
// read    small    the picture on 160 x 144 pixels, linear
//         before   the shade of the frame before; below 0 in the first one
// write   shade    0 (dark) to 1
#include "common/view.glsl"
#include "common/srgb.glsl"

uniform sampler2D small, before;
layout(std140) uniform Parameters { float response; };
out float shade;

void main() {
  const float bayer[16] = float[](0.0, 8.0, 2.0, 10.0, 12.0, 4.0, 14.0, 6.0, 3.0, 11.0, 1.0, 9.0, 15.0, 7.0, 13.0, 5.0);
  ivec2 at = ivec2(gl_FragCoord.xy);
  float gray = dot(encodeSrgb(clamp(texelFetch(small, at, 0).rgb, 0.0, 1.0)), vec3(0.2126, 0.7152, 0.0722));
  float wanted = min(floor(3.0 * gray + (bayer[4 * (at.y & 3) + (at.x & 3)] + 0.5) / 16.0), 3.0) / 3.0;
  float old = texelFetch(before, at, 0).r;
  shade = old < 0.0 || response <= 0.0 ? wanted : mix(wanted, old, exp(-delta_time / response));
}
