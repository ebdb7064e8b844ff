// Discs below kLarge, gathered from the full picture: those of nearer surfaces that reach a pixel, over the mean within its own disc.
// Eight pixels at once, which share what they read. Scene-referred.
// read    color    radiance
//         depth    reversed-Z; the sky, 0, is infinitely far
//         tiles, work   from far_tiles
//         far      the far field, `as linear`: what is seen beside a nearer surface is blurred
// write   red_green, blue_alpha   premultiplied, in tiles that small discs reach; alpha: what they hide of the picture with the large discs
//         of the far field; all of it before the focus, see over.frag.glsl
// params  infinity, focus   as in split
//         blades   of the aperture, for POLYGON
// defines FAR_TILE  texels of the fields along a tile's side
layout(local_size_x = FAR_TILE / (SCALE == 2 ? 2 : 4), local_size_y = FAR_TILE / (SCALE == 2 ? 1 : 2)) in;  // a tile
#define NEAR 0
#include "dof/texels.glsl"
#include "common/finite.glsl"
#include "common/view.glsl"
#include "dof/small/work.glsl"

uniform sampler2D color, depth, tiles, far;
layout(rg16f) uniform writeonly image2D red_green, blue_alpha;
layout(std140) uniform Parameters {
  float infinity;
  float focus;
  int blades;
};

float roundness;

// Discs are gathered from half a pixel on.
float startOf(float radius) { return smoothstep(0.5, 1.0, abs(radius)); }

float radiusAt(vec2 place) { return cocRadius(textureLod(depth, place, 0.0).r, infinity, focus, 1e4); }

const int kReach = 3;  // pixels to either side that a disc may cover
const int kWide = 2 * kReach + 1;

// A disc ends over 1 / kEdge pixels, which a smooth step makes as even in all directions as areas of pixels would, and its light exact to
// two percent. This adds to its variance. Returns kEdge times the radius.
const float kEdge = 0.6;
vec4 edgeOf(vec4 radius) {
  vec4 within = sqrt(max(radius * radius - 0.3, vec4(0.08)));
  return min(kEdge * within, kEdge * float(kReach + 1) - 0.5) + 0.5;
}
vec4 inside(vec4 edge, float across) {
  vec4 share = clamp(edge - across, 0.0, 1.0);
  return share * share * (3.0 - 2.0 * share);
}

// Four pixels beside each other.
struct Four {
  vec4 own, per_gap, size;
  vec4 over_r, over_g, over_b, over_a, rest_r, rest_g, rest_b, rest_a;
  vec4 fields;  // what the fields have of the discs in `over`
};

#define FOUR(of, i) vec4(of[i], of[i + 1], of[i + 2], of[i + 3])
#define FOUR_OF(of, i, c) vec4(of[i].c, of[i + 1].c, of[i + 2].c, of[i + 3].c)
// Of the own surface a disc counts whose size lies a little towards the other pixel's: so all light of a curved surface is somewhere.
#define TAKE(k) { \
  float across = kEdge * sqrt(up + float((k - kReach) * (k - kReach))); \
  vec4 apart = (four.own - FOUR(radius, k)) * four.per_gap, nearer = clamp(apart - 1.0, 0.0, 1.0); \
  vec4 covered = nearer * inside(FOUR(wide, k), across), front = covered * FOUR(light, k); \
  four.fields += covered * FOUR(other, k); \
  vec4 back = inside(four.size + clamp(1.0 - abs(apart), 0.0, 0.25) * (FOUR(wide, k) - four.size), across); \
  back -= back * nearer; \
  vec4 c = FOUR_OF(row, k, r); four.over_r += front * c; four.rest_r += back * c; \
  c = FOUR_OF(row, k, g); four.over_g += front * c; four.rest_g += back * c; \
  c = FOUR_OF(row, k, b); four.over_b += front * c; four.rest_b += back * c; \
  four.over_a += front; four.rest_a += back; }

void add(inout Four four, vec3 row[kWide + 3], float radius[kWide + 3], float wide[kWide + 3], float light[kWide + 3],
         float other[kWide + 3], float y) {
  float up = y * y;
  TAKE(0) TAKE(1) TAKE(2) TAKE(3) TAKE(4) TAKE(5) TAKE(6)
}

Four start(vec4 own) {
  const vec4 none = vec4(0.0);
  return Four(own, 1.0 / gapAt(own), edgeOf(roundness * abs(own)), none, none, none, none, none, none, none, none, none);
}

vec4 resultOf(Four four, int i) {
  vec4 front = vec4(four.over_r[i], four.over_g[i], four.over_b[i], four.over_a[i]);
  vec4 back = vec4(four.rest_r[i], four.rest_g[i], four.rest_b[i], four.rest_a[i]);
  front /= max(1.0 - four.fields[i], 0.1);  // both parts are laid over each other, and add up
  front /= max(front.a, 1.0);
  float own = four.own[i], share = (1.0 - front.a) * startOf(own) * (own > 0.0 ? 1.0 - fieldShare(own) : 1.0);
  return front + back * (share / max(back.a, 1e-6));
}

void store(Four four, ivec2 at) {
  for (int i = 0; i < 4; ++i) {
    vec4 result = resultOf(four, i);
    imageStore(red_green, at + ivec2(i, 0), vec4(result.rg, 0.0, 0.0));
    imageStore(blue_alpha, at + ivec2(i, 0), vec4(result.ba, 0.0, 0.0));
  }
}

void main() {
  ivec2 tile = tileOfGroup(), at = (tile * ivec2(gl_WorkGroupSize.xy) + ivec2(gl_LocalInvocationID.xy)) * ivec2(4, 2);
  vec2 texel = 1.0 / vec2(textureSize(color, 0)), to_far = vec2(textureSize(color, 0)) / vec2(textureSize(far, 0) * SCALE);
  roundness = roundnessOf(blades);
  vec4 low, high;
  for (int i = 0; i < 4; ++i) {
    low[i] = radiusAt((vec2(at + ivec2(i, 0)) + 0.5) * texel);
    high[i] = radiusAt((vec2(at + ivec2(i, 1)) + 0.5) * texel);
  }
  Four a = start(low), b = start(high);
  int rows = min(int(ceil(texelFetch(tiles, tile, 0).g + 0.5 / kEdge)) - 1, kReach);
  for (int y = -rows; y <= rows + 1; ++y) {
    vec3 row[kWide + 3];
    float radius[kWide + 3], wide[kWide + 3], light[kWide + 3], other[kWide + 3];
    for (int i = 0; i < kWide + 3; ++i) {
      vec2 place = (vec2(at + ivec2(i - kReach, y)) + 0.5) * texel;
      vec4 blurred = textureLod(far, place * to_far, 0.0);
      radius[i] = radiusAt(place);
      row[i] = blurred.a > 0.0 && radius[i] >= kLarge ? blurred.rgb / blurred.a : finite(textureLod(color, place, 0.0).rgb);
      wide[i] = edgeOf(vec4(roundness * radius[i])).x;
      float within = (wide[i] - 0.5) / kEdge;
      float area = 3.14159265 * within * within + 0.45, in_fields = fieldShare(radius[i]);
      light[i] = startOf(radius[i]) * (1.0 - in_fields) / area;
      other[i] = in_fields < 1.0 ? in_fields / area : 0.0;
    }
    add(a, row, radius, wide, light, other, float(y));
    add(b, row, radius, wide, light, other, float(y - 1));
  }
  store(a, at);
  store(b, at + ivec2(0, 1));
}
