// Motion blur over an open shutter, centered on the frame, in the tiles that gather.vert.glsl picks. Scene-referred.
// read    red_green, blue_alpha   from copy.frag.glsl; all textures by any sampler (texels are fetched)
//         velocity, depth  screen UV per frame, reversed-Z
//         tiles, more?     from motions
//         second_still?, second_velocity?, second_depth?   radiance and the others of the second layer; all or none
// modify  result     radiance; alpha stays
// params  shutter    degrees: 360 is open all the time between two frames
//         samples    most moments of the shutter's time; short streaks take two per pixel of their length
//         tile       pixels along a tile's side; also limits the blur
//
// For each of several moments, finds the texel that is at the pixel then: one whose streak leads there. This depends on the texel's own
// motion, so it is searched along the motion of the pixel and up to four motions around it (tiles after McGuire et al., "A reconstruction
// filter for plausible motion blur", I3D 2012). Of the texels that arrive at the pixel, the nearest is visible. With a second layer, its
// texels count too. Edges of the picture are extended. Where no texel arrives, a surface comes into view that was not drawn: it is
// extrapolated from the nearest visible texel of the surface behind, and from the change between that and the texel as far beyond.
#include "common/finite.glsl"
#include "blur.glsl"

uniform sampler2D red_green, blue_alpha, velocity, depth, tiles;
#ifdef HAS_MORE
uniform sampler2D more;
#endif
#ifdef HAS_SECOND_STILL
uniform sampler2D second_still, second_velocity, second_depth;
#endif
layout(std140) uniform Parameters {
  float shutter;
  int samples;
  int tile;
};
out vec4 result;

const float kBehind = 0.95;  // depth of what counts as behind a surface of depth 1
const float kGoesOn = 0.7;   // share of a change of light that is extrapolated where a surface is hidden
const float kMiss = 0.6;     // pixels: a texel that passes so close to the pixel's center arrives

// Half the path of a texel while the shutter is open, in pixels, and its depth.
vec3 streakAt(sampler2D velocities, sampler2D depths, ivec2 at) {
  vec2 path = streakOf(texelFetch(velocities, at, 0).rg, vec2(textureSize(velocities, 0)), shutter, tile);
  return vec3(path, texelFetch(depths, at, 0).r);
}

vec3 stillAt(ivec2 at) { return vec3(texelFetch(red_green, at, 0).rg, texelFetch(blue_alpha, at, 0).r); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(velocity, 0) - 1;
  vec2 size = vec2(last + 1), here = gl_FragCoord.xy;
  vec3 own = streakAt(velocity, depth, pixel);
  vec4 two = texelFetch(tiles, pixel / tile, 0), others = two.xyxy;
#ifdef HAS_MORE
  others = texelFetch(more, pixel / tile, 0);
#endif
  vec2 longest = streakOf(two.xy, size, shutter, tile);
  int n = min(samples, int(ceil(4.0 * length(longest))) + 1);
  // The middles of equal steps, which err least; where steps are longer than a pixel, noise moves them, because they would show as bands.
  float random = fract(52.9829189 * fract(dot(here, vec2(0.06711056, 0.00583715))));
  float noise = 0.5 + (random - 0.5) * clamp(1.0 - 0.5 * float(n) / length(longest), 0.0, 1.0);
  bool alike = two.xy == two.zw && two.xy == others.xy && two.xy == others.zw;
  vec3 sum = vec3(0.0);

  // Everything around moves alike.
  for (int i = 0; i < (alike ? n : 0); ++i) {
    float t = (float(i) + noise) / float(n) * 2.0 - 1.0;
    sum += stillAt(clamp(ivec2(floor(here - own.xy * t)), ivec2(0), last));
  }

  vec2 around[4] = vec2[](longest, two.zw, others.xy, others.zw);
  int motions = 0;
  for (int i = 0; i < 4; ++i) {
    vec2 motion = i == 0 ? longest : streakOf(around[i], size, shutter, tile);
    bool known = distance(motion, own.xy) < 0.5 || (i > 0 && distance(motion, longest) < 0.25);
    around[motions] = motion;
    motions += known ? 0 : 1;
  }
  int tries = motions > 0 ? motions + 3 : 2;
  for (int i = 0; i < (alike ? 0 : n); ++i) {
    float t = (float(i) + noise) / float(n) * 2.0 - 1.0, seen = -1.0;
    ivec2 seen_at = pixel, beyond = pixel;
    float goes_on = 0.0;
#ifdef HAS_SECOND_STILL
    bool seen_behind = false;
#endif
    // The pixel's own motion and that of the texel found by it, the first of the others and that of the texel found by it, the rest.
    vec2 motion = own.xy;
    vec3 first = own;  // what the pixel's own motion leads to
    for (int k = 0; k < tries; ++k) {
      if (k == 2) motion = around[0];
      if (k > 3) motion = around[k - 3];
      vec2 from = floor(here - motion * t), way = here - from - 0.5;
      ivec2 at = clamp(ivec2(from), ivec2(0), last);
      vec3 found = streakAt(velocity, depth, at);
      vec2 miss = abs(found.xy * t - way);
      bool arrives = max(miss.x, miss.y) < kMiss && found.z > seen;
      seen = arrives ? found.z : seen;
      seen_at = arrives ? at : seen_at;
#ifdef HAS_SECOND_STILL
      vec3 behind = streakAt(second_velocity, second_depth, at);
      miss = abs(behind.xy * t - way);
      bool arrives_behind = max(miss.x, miss.y) < kMiss && behind.z > seen;
      seen = arrives_behind ? behind.z : seen;
      seen_at = arrives_behind ? at : seen_at;
      seen_behind = arrives_behind || (seen_behind && !arrives);
#endif
      motion = found.xy;
      first = k == 0 ? found : first;
    }
    if (seen < 0.0) {
      // Either the pixel's surface leaves and the background comes into view, or the pixel is on the background, whose texel a nearer
      // surface covers. That texel would be at `hidden`; the nearer surface ends at `beside` at the latest, since it is not at the pixel
      // then.
      bool covered = own.z < kBehind * first.z;
      vec3 front = covered ? first : own, back = covered ? own : first;
      vec2 hidden = here - back.xy * t, beside = here - front.xy * t;
      for (int k = 4; k >= 0; --k) {
        ivec2 at = clamp(ivec2(floor(mix(hidden, beside, 0.25 * float(k)))), ivec2(0), last);
        seen_at = kBehind * texelFetch(depth, at, 0).r <= back.z ? at : seen_at;
      }
      beyond = clamp(2 * seen_at - ivec2(floor(hidden)), ivec2(0), last);
      vec3 beside_it = streakAt(velocity, depth, seen_at), beyond_it = streakAt(velocity, depth, beyond);
      bool same_depth = beside_it.z >= kBehind * beyond_it.z && beyond_it.z >= kBehind * beside_it.z;
      bool is_copied = texelFetch(blue_alpha, beyond, 0).g > 0.0;
      bool same = same_depth && is_copied && distance(beside_it.xy, beyond_it.xy) < 0.5;
      goes_on = same ? kGoesOn : 0.0;
    }
#ifdef HAS_SECOND_STILL
    vec3 light = seen_behind ? finite(texelFetch(second_still, seen_at, 0).rgb) : stillAt(seen_at);
#else
    vec3 light = stillAt(seen_at);
#endif
    vec3 change = goes_on * (light - stillAt(beyond));
    sum += clamp(light + change, 0.5 * light, 2.0 * light);
  }
  result = vec4(sum / float(n), texelFetch(blue_alpha, pixel, 0).g);
}
