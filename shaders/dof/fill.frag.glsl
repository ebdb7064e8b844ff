// Closes the gaps between the samples of bokeh: the mean with the eight texels around, as far as the discs are large enough.
// Scene-referred, premultiplied.
// read    blurred  from bokeh; all by any sampler (texels are fetched)
//         source   from split
//         discs    from split
//         tiles?   from reach, for NEAR
// write   result
// params  tile, largest   as in bokeh
// defines NEAR, 1 from near_fill
#ifndef NEAR
#define NEAR 0
#endif
uniform sampler2D blurred, source, discs;
layout(std140) uniform Parameters {
  int tile;
  int largest;
};
out vec4 result;
#include "disc.glsl"

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(blurred, 0) - 1;
#if NEAR
  float around = fillWeight(searchRadius(pixel));
#else
  float around = fillWeight(searchRadius(texelFetch(source, pixel, 0).a, pixel, discs, largest));
#endif
  ivec2 low = max(pixel - 1, ivec2(0)), high = min(pixel + 1, last);
  vec4 middle = texelFetch(blurred, pixel, 0);
  vec4 sides = vec4(0.0), corners = vec4(0.0);
  for (int i = 0; i < (around > 0.0 ? 1 : 0); ++i) {
    sides = texelFetch(blurred, ivec2(low.x, pixel.y), 0) + texelFetch(blurred, ivec2(high.x, pixel.y), 0) +
            texelFetch(blurred, ivec2(pixel.x, low.y), 0) + texelFetch(blurred, ivec2(pixel.x, high.y), 0);
    corners = texelFetch(blurred, low, 0) + texelFetch(blurred, high, 0) + texelFetch(blurred, ivec2(low.x, high.y), 0) +
              texelFetch(blurred, ivec2(high.x, low.y), 0);
  }
  result = (middle + around * (sides + around * corners)) / ((1.0 + 2.0 * around) * (1.0 + 2.0 * around));
}
