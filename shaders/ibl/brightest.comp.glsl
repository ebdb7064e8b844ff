// Finds the brightest spots of the environment, one after the other, and the light of each that exceeds its surroundings.
// read    environment  equirectangular with mips
//         luminance    the mean luminance over the sphere, vec4
// write   brightest    see brightest.glsl
//
// One work group. Each time the brightest texel counts that is not in the window or the ring of one before. The light above kStandsOut times
// the mean within 5 degrees of it is a spot when the ring around it, as wide again, has less than a tenth of that light; colors are cut in
// proportion. Of a spot with less than kMatters of the first's light a shadow takes less than 8 of 255 levels where both shine: it stays in
// the map, as what is no compact spot does.
#include "common/equirect_direction.glsl"
#include "spot.glsl"

layout(local_size_x = 256) in;
uniform sampler2D environment;
layout(std140) uniform luminance { vec4 mean_luminance; };
layout(std430) writeonly buffer brightest {
  Spot spots[kSpots];
  int spot_count;
  float sun_radius;
};

const float kStandsOut = 16.0, kMatters = 1.0 / 16.0;
const int kTries = 8;

shared vec4 part[256];
shared vec4 part_moment[256];
shared vec3 tried[kTries];   // directions
shared Spot found[kSpots];
shared int found_count, tries;

float luminanceOf(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }
float most(vec3 color) { return max(color.r, max(color.g, color.b)); }

int levelOfWidth(int width) {
  return clamp(int(ceil(log2(float(textureSize(environment, 0).x) / float(width)))), 0, textureQueryLevels(environment) - 1);
}

vec3 directionOf(ivec2 texel, ivec2 size) { return equirectDirection((vec2(texel) + 0.5) / vec2(size)); }

void main() {
  uint lane = gl_LocalInvocationID.x;
  float limit = kStandsOut * mean_luminance.x;
  if (lane == 0u) {
    for (int i = 0; i < kSpots; ++i) found[i] = kNoSpot;
    found_count = 0;
    tries = kTries;
  }
  barrier();

  for (int turn = 0; turn < tries; ++turn) {
    // The brightest texel of a small level; the first of equals.
    int level = levelOfWidth(512);
    ivec2 size = textureSize(environment, level);
    vec2 best = vec2(-1.0, 0.0);
    for (int i = int(lane); i < size.x * size.y; i += 256) {
      ivec2 texel = ivec2(i % size.x, i / size.x);
      float value = most(texelFetch(environment, texel, level).rgb);
      for (int k = 0; k < turn && value > best.x; ++k)
        if (distance(directionOf(texel, size), tried[k]) < 2.0 * kWindow) value = -1.0;
      if (value > best.x) best = vec2(value, intBitsToFloat(i));
    }
    part[lane] = vec4(best, 0.0, 0.0);
    barrier();
    // One lane adds the parts, instead of a reduction in eight rounds: each barrier makes the program larger, and in software its translation
    // takes longer than all of its work.
    if (lane == 0u) {
      for (uint other = 1u; other < 256u; ++other) {
        vec2 here = part[other].xy;
        bool earlier = floatBitsToInt(here.y) < floatBitsToInt(best.y);
        if (here.x > best.x || (here.x == best.x && earlier)) best = here;
      }
      int peak = floatBitsToInt(best.y);
      tried[turn] = directionOf(ivec2(peak % size.x, peak / size.x), size);
    }
    barrier();
    vec3 center = tried[turn];

    // Light above the limit, in the window and in the ring around it.
    level = levelOfWidth(2048);
    size = textureSize(environment, level);
    vec2 middle = equirectUv(center) * vec2(size);
    float height = 2.0 * kWindow / kPi * float(size.y);
    float from_pole = max(sqrt(max(1.0 - center.y * center.y, 0.0)) - 2.0 * kWindow, 0.0);
    float width = from_pole > 0.0 ? min(kWindow / (kPi * from_pole) * float(size.x), 0.5 * float(size.x)) : 0.5 * float(size.x);
    ivec2 first = ivec2(floor(middle - vec2(width, height))), last = ivec2(ceil(middle + vec2(width, height)));
    first.y = max(first.y, 0);
    last.y = min(last.y, size.y - 1);
    last.x = min(last.x, first.x + size.x - 1);
    int columns = last.x - first.x + 1, count = columns * (last.y - first.y + 1);
    // The solid angle of a texel is its width in radians times cos(a) - cos(b), of its upper and its lower edge: the sine of its middle times
    // this.
    float row = 4.0 * kPi / float(size.x) * sin(0.5 * kPi / float(size.y));
    vec4 sum = vec4(0.0), moment = vec4(0.0);
    for (int i = int(lane); i < count; i += 256) {
      ivec2 texel = first + ivec2(i % columns, i / columns);
      texel.x = (texel.x % size.x + size.x) % size.x;
      vec3 color = texelFetch(environment, texel, level).rgb;
      float above = most(color) - limit;
      vec3 direction = directionOf(texel, size), offset = direction - center;
      float away = length(offset);
      if (above <= 0.0 || away > 2.0 * kWindow) continue;
      vec3 cut = color * (above / most(color) * length(direction.xz) * row);
      if (away > kWindow) {
        sum.a += luminanceOf(cut);
      } else {
        sum.rgb += cut;
        moment += vec4(offset, dot(offset, offset)) * luminanceOf(cut);
      }
    }
    part[lane] = sum;
    part_moment[lane] = moment;
    barrier();
    if (lane == 0u) {
      for (uint other = 1u; other < 256u; ++other) {
        sum += part[other];
        moment += part_moment[other];
      }
      float weight = luminanceOf(sum.rgb);
      if (weight > max(10.0 * sum.a, kMatters * luminanceOf(found[0].light.rgb))) {
        moment /= weight;
        found[found_count].at = vec4(normalize(center + moment.xyz), limit);
        found[found_count].light = vec4(sum.rgb, 0.5 * max(moment.w - dot(moment.xyz, moment.xyz), 0.0));
        ++found_count;
      }
      if (weight <= 0.0 || found_count == kSpots) tries = 0;
    }
    barrier();
  }

  if (lane != 0u) return;
  for (int i = 0; i < kSpots; ++i) spots[i] = found[i];
  spot_count = found_count;
  sun_radius = 0.0;
}
