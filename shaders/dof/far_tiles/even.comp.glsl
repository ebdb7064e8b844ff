// The far field where all discs are alike: the mean over a disc, for sixteen texels at once, which share their samples. What is in focus or
// hidden does not count. Scene-referred.
// read    source   from split, the far field
//         tiles    from find.comp.glsl
// modify  result   premultiplied, alpha 1; only where something is blurred, in tiles whose discs are alike
// params  blades   of the aperture, for POLYGON
// defines FAR_TILE  texels of the fields along a tile's side
//         POLYGON
layout(local_size_x = 4, local_size_y = 4) in;
#define NEAR 0
#include "dof/texels.glsl"

uniform sampler2D source, tiles;
layout(rgba16f) uniform writeonly image2D result;
layout(std140) uniform Parameters { int blades; };

// Four texels beside each other.
struct Four {
  vec4 red, green, blue, alpha, own;  // own: the share of each that is blurred
};

const int kReach = 3;  // texels to either side that the disc of the largest radius covers
const int kWide = 2 * kReach + 1;

float roundness, reach;

// Adds the samples of a row, `up` rows above the four, to the disc of each. A share is that of texelWithin() in discs as large as these.
void add(inout Four four, vec4 row[kWide + 3], int up) {
  for (int i = 0; i < kWide; ++i) {
    float share = clamp(reach + 0.5 - acrossOf(vec2(i - kReach, up), roundness, blades), 0.0, 1.0);
    four.red += share * vec4(row[i].r, row[i + 1].r, row[i + 2].r, row[i + 3].r);
    four.green += share * vec4(row[i].g, row[i + 1].g, row[i + 2].g, row[i + 3].g);
    four.blue += share * vec4(row[i].b, row[i + 1].b, row[i + 2].b, row[i + 3].b);
    four.alpha += share * vec4(row[i].a, row[i + 1].a, row[i + 2].a, row[i + 3].a);
  }
  four.own = up == 0 ? vec4(row[kReach].a, row[kReach + 1].a, row[kReach + 2].a, row[kReach + 3].a) : four.own;
}

void store(Four four, ivec2 at, bool even) {
  for (int i = 0; i < 4; ++i)
    if (even && four.own[i] > kLeastShare)
      imageStore(result, at + ivec2(i, 0), vec4(vec3(four.red[i], four.green[i], four.blue[i]) / four.alpha[i], 1.0));
}

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy) * 4;
  vec2 texel = 1.0 / vec2(textureSize(source, 0));
  float radius = texelFetch(tiles, min(at / FAR_TILE, textureSize(tiles, 0) - 1), 0).r;
  bool even = radius > 0.0;
  roundness = roundnessOf(blades);
  reach = reachInTexels(radius * roundness);
  Four none = Four(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0)), a = none, b = none, c = none, d = none;
  for (int y = even ? -kReach : kReach + 3; y <= kReach + 3; ++y) {
    vec4 row[kWide + 3];
    for (int i = 0; i < kWide + 3; ++i) row[i] = textureLod(source, (vec2(at + ivec2(i - kReach, y)) + 0.5) * texel, 0.0);
    add(a, row, y);
    add(b, row, y - 1);
    add(c, row, y - 2);
    add(d, row, y - 3);
  }
  store(a, at, even);
  store(b, at + ivec2(0, 1), even);
  store(c, at + ivec2(0, 2), even);
  store(d, at + ivec2(0, 3), even);
}
