// The picture at the size of the fields, half or full, in two layers, near field and far field, which never mix. Scene-referred.
// read    color   radiance; both nearest
//         depth   reversed-Z; the sky, 0, is infinitely far
// write   near    radiance of the near field, premultiplied, and its share of the texel: 0, a quarter, ... 1
//         disc    radius of the disc in texels of the fields, times the share, of either field
//         far     radiance of the nearest blurred surface of the rest, premultiplied, and its share of the pixel. Surfaces in focus have
//                 next to none, so that they do not count in a mean with blurred ones; 0 where the near field hides all of it
//         idle    see idle.glsl
// params  infinity  radius in pixels of the full picture of a point infinitely far away
//         focus     distance in focus, world units along the view axis
//         largest   limit of the radius, pixels of the full picture
#include "coc.glsl"
#include "idle.glsl"
#include "common/finite.glsl"

uniform sampler2D color, depth;
layout(std140) uniform Parameters {
  float infinity;
  float focus;
  int largest;
};
out vec4 near;
out vec2 disc;
out vec4 far;

// A surface of the far field ends where radii exceed this multiple of the least radius in the pixel. What is farther away has larger discs
// and is also visible in other pixels, so small objects keep their own discs.
float endOfSurface(float radius) { return 1.3 * radius + 0.5; }

void main() {
  const int pixels = SCALE * SCALE;
  const float part = 1.0 / float(pixels);
  vec2 texel = 1.0 / vec2(textureSize(color, 0)), middle = gl_FragCoord.xy * float(SCALE) * texel;
#if SCALE == 2
  vec4 depths = textureGather(depth, middle).wzxy, radii;
#else
  vec4 depths = vec4(textureLod(depth, middle, 0.0).r), radii;
#endif
  float end = 1e9;
  for (int i = 0; i < pixels; ++i) {
    radii[i] = cocRadius(depths[i], infinity, focus, float(largest) - 1.0);
    if (radii[i] >= kSmall) end = min(end, endOfSurface(radii[i]));
  }
  vec4 near_mean = vec4(0.0);
  float near_count = 0.0, far_disc = 0.0, small = 0.0;
  far = vec4(0.0);
  for (int i = 0; i < pixels; ++i) {
    vec2 at = middle + (vec2(i & 1, i >> 1) - 0.5) * texel * float(SCALE - 1);
    float radius = radii[i];
    vec4 c = vec4(finite(textureLod(color, at, 0.0).rgb), abs(radius) / float(SCALE));
    bool nearer = radius < -kSmall;
    small = max(small, abs(radius) < kLarge ? abs(radius) : 0.0);
    near_mean += c * float(nearer);
    near_count += float(nearer);
    float w = nearer || radius > end ? 0.0 : part * (radius > kSmall ? 1.0 : 0.5 * kLeastShare);
    far += vec4(c.rgb, 1.0) * w;
    far_disc += c.a * w;
  }
  float share = part * near_count;
  near_mean /= max(near_count, 1.0);
  near = vec4(near_mean.rgb, 1.0) * share;
  disc = vec2(near_mean.a * share, far_disc);
  // A texel that is in part of the near field and else in focus has nothing for far_bokeh to blur, but shows what is behind.
  bool busy = far.a > 0.0 && far_disc / far.a > kLeastRadius;
  gl_FragDepth = workOf(busy, !busy && near_mean.a > kLeastRadius, small);
}
