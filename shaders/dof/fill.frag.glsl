// Closes the gaps between the samples of bokeh by a mean of nine places around each pixel, where discs are large enough.
// Scene-referred, premultiplied.
// read    blurred  from bokeh, `as linear`
//         source   from split
//         discs    from split
//         tiles?   from reach, for NEAR
// write   result
// params  see parameters.glsl
// defines NEAR, default 0
#ifndef NEAR
#define NEAR 0
#endif
uniform sampler2D blurred, source, discs;
#include "parameters.glsl"
out vec4 result;
#include "disc.glsl"

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
#if NEAR
  float radius = searchRadius(pixel), own = ownDisc(pixel);
  if (own > 0.0) radius = min(radius, 1.4 * own);
#else
  float radius = searchRadius(texelFetch(source, pixel, 0).a, texelFetch(discs, pixel, 0).rg);
#endif
  float variance = fillVariance(radius, gapOf(radius, rings)), around = fillWeight(variance),
        stride = fillStride(variance);
  vec2 to_uv = 1.0 / vec2(textureSize(blurred, 0)), low = (gl_FragCoord.xy - stride) * to_uv,
       at = gl_FragCoord.xy * to_uv, high = (gl_FragCoord.xy + stride) * to_uv;
  vec4 middle = textureLod(blurred, at, 0.0);
  vec4 sides = vec4(0.0), corners = vec4(0.0);
  for (int i = 0; i < (around > 0.0 ? 1 : 0); ++i) {
    sides = textureLod(blurred, vec2(low.x, at.y), 0.0) + textureLod(blurred, vec2(high.x, at.y), 0.0) +
            textureLod(blurred, vec2(at.x, low.y), 0.0) + textureLod(blurred, vec2(at.x, high.y), 0.0);
    corners = textureLod(blurred, low, 0.0) + textureLod(blurred, high, 0.0) +
              textureLod(blurred, vec2(low.x, high.y), 0.0) + textureLod(blurred, vec2(high.x, low.y), 0.0);
  }
  result = (middle + around * (sides + around * corners)) / ((1.0 + 2.0 * around) * (1.0 + 2.0 * around));
}
