// The mean of ambient visibility over 4 x 4 texels, the period of its sample directions, among texels of the same surface. The window is
// 5 wide with halved borders, so that it is centered and weighs each of the 16 equally.
// read    source          half size: visibility, distance along the view axis
//         depth, normal   the G-buffer's
// write   result          as `source`
// params  radius          world units
#include "blend.glsl"

uniform sampler2D source;
layout(std140) uniform Parameters { float radius; };
out vec2 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(source, 0) - 1, pixel = pixelOf(at);
  vec2 own = texelFetch(source, at, 0).rg;
  result = own;
  if (own.g <= 0.0) return;
  vec3 place = placeAt(pixel, texelFetch(depth, pixel, 0).r), n = facing(pixel);
  float thickness = thicknessAt(radius, own.g), sum = 0.0, weights = 0.0;
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      ivec2 there = clamp(at + ivec2(x, y), ivec2(0), last);
      vec2 other = texelFetch(source, there, 0).rg;
      float weight = (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0);
      weight *= onPlane(place, n, thickness, pixelOf(there), other.g);
      sum += weight * other.r;
      weights += weight;
    }
  if (weights > 0.0) result.r = sum / weights;
}
