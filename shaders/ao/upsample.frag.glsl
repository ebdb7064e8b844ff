// Ambient visibility at full size: bilinear among the texels of this pixel's surface, or the nearest in depth.
// read    source          half size: visibility, distance along the view axis
//         depth, normal   the G-buffer's
// write   result          full size, 0..1; the sky is 1
// params  radius          world units
//         strength        exponent of the visibility; 1 leaves it unchanged
#include "blend.glsl"

uniform sampler2D source;
layout(std140) uniform Parameters {
  float radius;
  float strength;
};
out float result;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(source, 0) - 1;
  float z = texelFetch(depth, pixel, 0).r;
  result = 1.0;
  if (z <= 0.0) return;
  Surface surface = surfaceAt(pixel, z, radius);
  float sum = 0.0, weights = 0.0, nearest = 1.0, least = 1e30;
  for (int i = 0; i < 4; ++i) {
    ivec2 step = ivec2(i & 1, i >> 1), there = min(pixel / 2 + step, last);
    vec2 other = texelFetch(source, there, 0).rg;
    vec2 share = mix(1.0 - 0.5 * vec2(pixel & 1), 0.5 * vec2(pixel & 1), equal(step, ivec2(1)));
    float weight = share.x * share.y * onSurface(surface, pixelOf(there), other.g);
    sum += weight * other.r;
    weights += weight;
    float apart = abs(other.g + surface.place.z);
    if (other.g > 0.0 && apart < least) {
      least = apart;
      nearest = other.r;
    }
  }
  result = pow(max(weights > 0.01 ? sum / weights : nearest, 0.0), strength);
}
