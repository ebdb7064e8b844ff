// Temporal anti-aliasing: mixes each frame, whose camera is jittered within a pixel, with earlier frames of the same surface.
// read    current         scene-referred radiance; any sampler (texels are fetched)
//         velocity        screen UV per frame, free of jitter
//         depth           reversed-Z, 0 is the sky
//         previous        `as linear`, the last `kept`: radiance, and in alpha the pixel's state, see below
//         previous_seen   the last `seen`
// write   kept            radiance and state
//         seen            least and greatest luma of the pixel, as x / (1 + x); depth; pixels per frame
//         result          radiance; alpha is that of `current`
// params  share           weight of a new frame while things move
//         frames          number of frames averaged while nothing moves; then the picture stays the same to the bit
//
// A pixel is in one of four states. 0: unknown. -1 .. -kYoung: it moves or has just come into view; this many frames are mixed.
// 1 .. kPeriod: it has been still for this many frames, and its range of values is recorded during one period of the jitter. Above: it has
// stayed in that range; frames have equal weight, until there are enough. A pixel that leaves its range has changed and starts again, so
// lights and shadows that move over still surfaces are followed. In the first three states the history is clipped to the neighborhood of
// the pixel in the current frame.
//
// Karis, "High-quality temporal supersampling" (SIGGRAPH 2014 courses): the nearest velocity of a neighborhood, clipping in YCoCg; Salvi,
// "An excursion in temporal supersampling" (GDC 2016): clipping by variance; Jimenez, "Filmic SMAA" (SIGGRAPH 2016 courses): Catmull-Rom in
// five lookups. All of it in linear light: compressed by a tone curve or with less weight for bright texels, as both say, the glint in a
// moving mirror of 16 pixels loses nearly all of its light.
#include "common/finite.glsl"

uniform sampler2D current, velocity, depth, previous, previous_seen;
layout(std140) uniform Parameters {
  float share;
  float frames;
};
in vec2 uv;
out vec4 kept;
out vec4 seen;
out vec4 result;

const float kPeriod = 16.0;  // of the camera's jitter
const float kYoung = 8.0;
const float kStill = 0.004;  // pixels per frame; a GPU places corners to 1/512, along each axis
const float kWide = 1.25;    // of the box that the history is clipped to, standard deviations
const float kSpot = 2.0, kGlint = 3.5;  // this many times the mean of 9 texels is a spot, of 21 a glint
const float kEqual = 0.002;  // differences below this, of x / (1 + x), are rounding

float lumaOf(vec3 color) { return dot(color, vec3(0.25, 0.5, 0.25)); }
vec3 toYcocg(vec3 c) { return vec3(lumaOf(c), 0.5 * (c.r - c.b), 0.5 * c.g - 0.25 * (c.r + c.b)); }
vec3 fromYcocg(vec3 c) { return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z); }

vec3 sharpHistory(vec2 at, vec2 size) {
  vec2 p = at * size, middle = floor(p - 0.5) + 0.5, f = p - middle;
  vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
  vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f)), w3 = f * f * (-0.5 + 0.5 * f), w12 = w1 + w2;
  vec2 t0 = (middle - 1.0) / size, t3 = (middle + 2.0) / size, t12 = (middle + w2 / w12) / size;
  vec4 sum = vec4(textureLod(previous, vec2(t12.x, t0.y), 0.0).rgb, 1.0) * (w12.x * w0.y);
  sum += vec4(textureLod(previous, vec2(t0.x, t12.y), 0.0).rgb, 1.0) * (w0.x * w12.y);
  sum += vec4(textureLod(previous, t12, 0.0).rgb, 1.0) * (w12.x * w12.y);
  sum += vec4(textureLod(previous, vec2(t3.x, t12.y), 0.0).rgb, 1.0) * (w3.x * w12.y);
  sum += vec4(textureLod(previous, vec2(t12.x, t3.y), 0.0).rgb, 1.0) * (w12.x * w3.y);
  return max(sum.rgb / sum.a, 0.0);
}

// Rounds to a half float above or below at random, so that the mean of many frames does not drift.
vec3 toHalf(vec3 color, ivec2 pixel, float salt) {
  uvec3 bits = floatBitsToUint(color);
  uint chance = uint(pixel.x) * 1664525u + uint(pixel.y) * 22695477u + uint(salt) * 2891336453u;
  chance = (chance ^ (chance >> 15)) * 0x2c1b3c6du;
  chance ^= chance >> 13;
  uvec3 rest = uvec3(chance, chance >> 7, chance >> 14) & 0x1fffu;
  vec3 rounded = min(uintBitsToFloat((bits + rest) & ~uvec3(0x1fffu)), vec3(65504.0));
  return mix(rounded, color, lessThan(color, vec3(1e-4)));  // those have fewer bits
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(current, 0) - 1;
  vec2 size = vec2(last + 1);
  vec4 own = texelFetch(current, pixel, 0);
  vec3 color = finite(own.rgb), sum = vec3(0.0), squares = vec3(0.0), darkest = color;
  float brightest = 0.0;
  ivec2 nearest = pixel;
  float near = -1.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      ivec2 at = clamp(pixel + ivec2(x, y), ivec2(0), last);
      vec3 there_now = finite(texelFetch(current, at, 0).rgb), c = toYcocg(there_now);
      darkest = min(darkest, there_now);
      brightest = max(brightest, c.x);
      sum += c;
      squares += c * c;
      float there = texelFetch(depth, at, 0).r;
      nearest = there > near ? at : nearest;
      near = max(near, there);
    }
  vec3 mean = sum / 9.0, wide = kWide * sqrt(max(squares / 9.0 - mean * mean, 0.0)) + 1e-4;

  vec2 moved = texelFetch(velocity, nearest, 0).rg;
  float speed = length(moved * size);
  bool still = speed < kStill;
  vec2 before = gl_FragCoord.xy / size - (still ? vec2(0.0) : moved);
  bool inside = all(greaterThan(before, vec2(0.0))) && all(lessThan(before, vec2(1.0)));
  ivec2 from = clamp(ivec2(before * size), ivec2(0), last);
  vec4 history = texelFetch(previous, from, 0), range = texelFetch(previous_seen, from, 0);
  // Everything there and around it was well in front of this surface: it has gone. Edges that only the jitter moves differ less.
  vec2 around = 2.0 / size;
  vec2 x = vec2(around.x, 0.0), y = vec2(0.0, around.y);
  float beside = min(textureLod(previous_seen, before + x, 0.0).b, textureLod(previous_seen, before - x, 0.0).b);
  float covered = min(beside, min(textureLod(previous_seen, before + y, 0.0).b, textureLod(previous_seen, before - y, 0.0).b));
  bool uncovered = min(covered, range.b) > 1.2 * near + 1e-6 && max(range.a, speed) >= kStill;
  float state = inside && !uncovered ? history.a : 0.0;

  float shown = lumaOf(color) / (1.0 + lumaOf(color));
  bool known = state > kPeriod && still;
  bool changed = known && (shown < range.x - kEqual || shown > range.y + kEqual);
  known = known && !changed;
  float mixed = changed ? 0.5 * kYoung : state > 0.0 ? kYoung : -state;  // frames in the history, if it is to be clipped
  float weight = known ? 1.0 / (state - kPeriod + 0.5 * kYoung) : max(1.0 / (mixed + 1.0), share);
  if (state == 0.0) weight = 1.0;

  vec3 old = still ? history.rgb : sharpHistory(before, size);
  // Around a glint the sharp filter would add light, since it never goes below zero, and a soft one lose it to the clipping.
  if (!still && brightest > kSpot * mean.x) old = mix(old, textureLod(previous, before, 0.0).rgb, 0.5);
  vec3 offset = toYcocg(old) - mean, ratio = abs(offset) / wide;
  float beyond = max(ratio.x, max(ratio.y, ratio.z));
  if (!known && beyond > 1.0) {
    // A glint in a moving mirror is a texel or four, and the jitter moves it by up to one: its history may be two texels away from it. So
    // there the box is that of 21 texels, up to the brightest of them.
    for (int i = 0; i < (still ? 0 : 12); ++i) {
      ivec2 side = ivec2(i % 3 - 1, i / 3 % 2 * 4 - 2), at = clamp(pixel + (i < 6 ? side : side.yx), ivec2(0), last);
      vec3 c = toYcocg(finite(texelFetch(current, at, 0).rgb));
      brightest = max(brightest, c.x);
      sum += c;
      squares += c * c;
    }
    vec3 wider = sum / 21.0;
    if (!still && brightest > kGlint * wider.x) {
      vec3 spread = sqrt(max(squares / 21.0 - wider * wider, 0.0)) + 1e-4;
      mean = wider;
      offset = toYcocg(old) - mean;
      ratio = abs(offset) * spread.x / (spread * (brightest - mean.x));
      beyond = max(max(ratio.x, max(ratio.y, ratio.z)), 1.0);
    }
    old = fromYcocg(mean + offset / beyond);
  }
  if (!known) old = max(old, darkest);  // no dark ring around a glint

  bool finished = known && state >= kPeriod + frames;
  vec3 mixture = finished ? history.rgb : toHalf(mix(old, color, weight), pixel, state);

  float next = finished ? state : known ? state + 1.0 : !still || changed || state == 0.0 || state <= 0.0 && mixed < kYoung
             ? -min(mixed + 1.0, kYoung) : max(state, 0.0) + 1.0;
  bool begins = next <= 1.0;
  kept = vec4(mixture, next);
  seen = vec4(begins ? shown : min(range.x, shown), begins ? shown : max(range.y, shown), near, min(speed, 1000.0));
  result = vec4(mixture, own.a);
}
