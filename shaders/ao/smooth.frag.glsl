// The mean of ambient visibility over texels of the same surface, in two passes: over 4 x 4 texels, which the search's directions cover
// evenly, then over those means. Windows are an odd number wide with halved borders, so that they are centered.
// read    source          half size: visibility, distance along the view axis
//         depth, normal   the G-buffer's
// write   result          as `source`
// params  radius          world units
// define  STRIDE          1, then 2: texels from one that counts to the next
//         REACH           2, then 1: how many of them count on each side
#include "blend.glsl"

uniform sampler2D source;
layout(std140) uniform Parameters { float radius; };
out vec2 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(source, 0) - 1, pixel = pixelOf(at);
  vec2 own = texelFetch(source, at, 0).rg;
  result = own;
  if (own.g <= 0.0) return;
  Surface surface = surfaceAt(pixel, texelFetch(depth, pixel, 0).r, radius);
  // The second pass keeps to what is not far behind or before, on surfaces seen from low angles.
  float sum = 0.0, weights = 0.0, near = STRIDE == 1 ? 1e30 : own.g * 24.0 / focalPixels().y;
  for (int y = -REACH; y <= REACH; ++y)
    for (int x = -REACH; x <= REACH; ++x) {
      ivec2 there = clamp(at + STRIDE * ivec2(x, y), ivec2(0), last);
      vec2 other = texelFetch(source, there, 0).rg;
      float weight = (abs(x) == REACH ? 0.5 : 1.0) * (abs(y) == REACH ? 0.5 : 1.0) * onSurface(surface, pixelOf(there), other.g);
      weight *= max(1.0 - abs(other.g - own.g) / near, 0.0);
      sum += weight * other.r;
      weights += weight;
    }
  if (weights > 0.0) result.r = sum / weights;
}
