// The picture at half size in two layers, near field and far field, so that they never mix. Scene-referred.
// read    color   radiance; both nearest
//         depth   reversed-Z; the sky, 0, is infinitely far
// write   near    radiance of the near field, premultiplied, and its share of the pixel: 0, a quarter, ... 1
//         disc    radius of its disc in pixels of the half size, times that share
//         far     the rest, premultiplied: see farAlpha; 0 where something nearer hides all of it
//         idle    depth: 0 where bokeh has anything to do for `far`, else 1
// params  infinity  radius in pixels of the full picture of a point infinitely far away
//         focus     distance in focus, world units along the view axis
//         largest   limit of the radius, pixels of the full picture
#include "coc.glsl"
#include "common/finite.glsl"

uniform sampler2D color, depth;
layout(std140) uniform Parameters {
  float infinity;
  float focus;
  int largest;
};
out vec4 near;
out float disc;
out vec4 far;

void main() {
  vec2 texel = 1.0 / vec2(textureSize(color, 0)), middle = gl_FragCoord.xy * 2.0 * texel;
  vec4 near_mean = vec4(0.0), far_mean = vec4(0.0);
  float near_weight = 0.0, far_weight = 0.0;
  float near_count = 0.0, far_light = 0.0, far_radius = 0.0;
  vec4 depths = textureGather(depth, middle).wzxy;
  for (int i = 0; i < 4; ++i) {
    vec2 at = middle + (vec2(i & 1, i >> 1) - 0.5) * texel;
    float radius = cocRadius(depths[i], infinity, focus, float(largest) - 1.0), blur = blurOf(radius);
    vec4 c = vec4(finite(textureLod(color, at, 0.0).rgb), abs(radius) * 0.5);
    bool nearer = radius < -0.5;
    float w = nearer ? blur : 0.0;
    near_mean += c * w;
    near_weight += w;
    near_count += float(nearer);
    w = nearer ? 0.0 : max(radius > 0.0 ? blur : 0.0, 1e-3);
    far_mean += c * w;
    far_weight += w;
    // Where surfaces share a pixel its disc is that of the light.
    far_light += w;
    far_radius += w * c.a;
  }
  float share = near_weight > 0.0 ? 0.25 * near_count : 0.0;
  near_mean /= max(near_weight, 1e-6);
  near = vec4(near_mean.rgb, 1.0) * share;
  disc = near_mean.a * share;
  far_mean = vec4(far_mean.rgb / max(far_weight, 1e-6), far_radius / max(far_light, 1e-10));
  float alpha = far_weight > 0.0 ? farAlpha(far_mean.a, largest) : 0.0;
  far = vec4(far_mean.rgb * alpha, alpha);
  gl_FragDepth = (alpha > 0.0 ? far_mean.a : disc) > kLeastRadius ? 0.0 : 1.0;
}
