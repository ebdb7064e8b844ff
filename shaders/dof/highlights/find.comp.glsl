// Finds highlights out of focus: the few texels far brighter than their surroundings, which show the outline of the aperture. This shader
// lists them for each tile, dim.comp.glsl removes their light from the fields, and draw.frag.glsl draws them at full size (scattering
// beside gathering; Abadie, "A life of a bokeh", SIGGRAPH 2018). Where a nearer surface may hide a highlight from a part of the lens, the
// draw tests for it.
// read    near, far    from split
//         discs        from split
//         tiles        from tiles
//         color        radiance, any sampler
// write   highlights   see list.glsl, one list per tile; a tile with too many has an empty list
// params  tile         texels of the fields along a tile's side
//         blades       of the aperture
//         largest      radius of the largest disc of the far field, pixels of the full picture
layout(local_size_x = 8, local_size_y = 8) in;
#include "dof/coc.glsl"
#include "list.glsl"

uniform sampler2D near, far, discs, tiles, color;
layout(std430) buffer highlights { TileHighlights lists[]; };
layout(std140) uniform Parameters {
  int tile;
  int blades;
  float largest;
};

const float kContrast = 4.0;       // a highlight is brighter than this times the mean of its tile
// The same for the radiance of the disc over the mean of the tile. A blend, so that moving highlights do not switch from frame to frame.
const float kLeastVisible = 0.01, kWholeVisible = 0.03;
// Ratio of the brightest texel around to the highlight: up to kAlone the highlight takes all light above it, from kNotAlone on none.
const float kAlone = 0.1, kNotAlone = 0.3;
const ivec2 kAround[8] =
    ivec2[8](ivec2(4, 0), ivec2(3, 3), ivec2(0, 4), ivec2(-3, 3), ivec2(-4, 0), ivec2(-3, -3), ivec2(0, -4), ivec2(3, -3));

// Brightness of a texel: its green in both fields, or in the picture where its first pixel is brighter: sharp ones are in no field.
float greenAt(ivec2 at) {
  at = clamp(at, ivec2(0), textureSize(far, 0) - 1);
  float green = texelFetch(color, min(at * SCALE, textureSize(color, 0) - 1), 0).g;
  return max(texelFetch(near, at, 0).g + texelFetch(far, at, 0).g, min(green, 65504.0));
}

// The same of four texels, in the order of textureGather: of `at`, the one to its right, and the two above these. `reached`: false where no
// disc of the near field reaches them, and `near` is not read.
vec4 greenAround(ivec2 at, bool reached) {
  vec2 middle = vec2(at + 1) / vec2(textureSize(far, 0));
  vec4 green = textureGather(far, middle, 1);
  return reached ? green + textureGather(near, middle, 1) : green;
}

// The sum of four texels at a time, and the brightest of each four; the sizes of fields and tiles are even.
void survey(ivec2 first, ivec2 end, bool reached, inout vec4 sum, inout vec4 most) {
  for (int y = first.y; y < end.y; y += 2)
    for (int x = first.x; x < end.x; x += 2) {
      vec4 green = greenAround(ivec2(x, y), reached);
      sum += green;
      most = max(most, green);
    }
}

// Whether the near field may hide a disc of radius `disc` at `at` from a part of the lens; both in texels of the fields. A disc of the near
// field is hidden by larger ones only: these are nearer.
bool isOverlaid(ivec2 at, float disc, bool is_near) {
  bool overlaid = false;
  for (int i = 0; i < 25; ++i) {
    ivec2 there = clamp(at / tile + ivec2(i % 5, i / 5) - 2, ivec2(0), textureSize(tiles, 0) - 1);
    float other = texelFetch(tiles, there, 0).r;
    vec2 away = vec2(max(max(there * tile - at, at - (there + 1) * tile), ivec2(0)));
    overlaid = overlaid || (other > (is_near ? 1.15 * disc : 0.0) && length(away) < disc + other);
  }
  return overlaid;
}
// Whether a nearer surface of the far field may; there nearer surfaces have smaller discs.
bool isCovered(ivec2 at, float disc) {
  bool covered = false;
  for (int i = 0; i < 16; ++i) {
    ivec2 there = clamp(at + ivec2(round(vec2(kAround[i & 7]) * (i < 8 ? 0.125 : 0.25) * disc)), ivec2(0), textureSize(far, 0) - 1);
    float share = texelFetch(far, there, 0).a;
    covered = covered || (share > 0.0 && texelFetch(discs, there, 0).g < 0.9 * disc * share);
  }
  return covered;
}

// The highlight in a texel. `mean` is the brightness of the tile. A `share` of 0 says that there is none.
Highlight highlightAt(ivec2 at, float mean) {
  Highlight found = Highlight(vec2(0.0), 0.0, 0.0, vec4(0.0));
  vec4 before = texelFetch(near, at, 0), behind = texelFetch(far, at, 0);
  bool is_near = before.g > behind.g;
  vec2 disc = texelFetch(discs, at, 0).rg;
  float radius = is_near ? disc.r / max(before.a, 0.25) : disc.g / max(behind.a, 1e-4), around = 0.0, green = before.g + behind.g;
  if (float(SCALE) * radius < kSmall) return found;
  for (int i = 0; i < 8; ++i) around = max(around, greenAt(at + kAround[i]));
  float share = (1.0 - around / green) * (1.0 - smoothstep(kAlone, kNotAlone, around / green));
  if (share <= 0.0) return found;
  bool partial = isOverlaid(at, radius, is_near) || (!is_near && isCovered(at, radius));
  radius *= float(SCALE);
  // The position of the light within the texel, and the width of the disc's edge. The edge is widened by the box of the source pixel, the
  // box of the target pixel, and the extent of the light within the texel. A linear ramp must be a seventh wider to be as steep in its
  // middle as the edge that boxes make. The first counts only a fifth: edges of lights are anti-aliased, so a pixel mostly has its light
  // from a part of it.
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < SCALE * SCALE; ++i) {
    ivec2 pixel = min(at * SCALE + ivec2(i % SCALE, i / SCALE), textureSize(color, 0) - 1);
    float weight = clamp(texelFetch(color, pixel, 0).g, around, 65504.0) - around + 1e-4;
    vec2 place = vec2(pixel - at * SCALE) + 0.5;
    sum += weight * vec3(place, 0.5 * dot(place, place));
    weights += weight;
  }
  sum /= weights;
  float soft = sqrt(1.6 + 16.0 * max(sum.z - 0.5 * dot(sum.xy, sum.xy), 0.0));
  vec3 light = (is_near ? before.rgb : behind.rgb) * share * (float(SCALE * SCALE) / areaOf(radius, soft, blades));
  float part = smoothstep(kLeastVisible, kWholeVisible, light.g / mean);
  if (part <= 0.0) return found;
  share *= part;
  light *= part;
  return Highlight(vec2(at * SCALE) + sum.xy, is_near ? -radius : radius, share, vec4(light, partial ? -soft : soft));
}

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), grid = textureSize(tiles, 0), size = textureSize(far, 0);
  if (any(greaterThanEqual(at, grid))) return;
  ivec2 first = at * tile, end = min(first + tile, size);
  vec4 sum = vec4(0.0), most = vec4(0.0);
  float reached = texelFetch(tiles, at, 0).r;  // by discs of the near field
  // No disc of this tile is large enough.
  if (max(float(SCALE) * reached, largest) < kSmall) end.y = first.y;
  // One of the two has no rows: in software, both sides of a condition are computed.
  survey(first, ivec2(end.x, reached > 0.0 ? first.y : end.y), false, sum, most);
  survey(first, ivec2(end.x, reached > 0.0 ? end.y : first.y), true, sum, most);
  ivec2 wide = max(end - first, ivec2(1));
  float mean = (sum.x + sum.y + sum.z + sum.w) / float(wide.x * wide.y);
  float brightest = max(max(most.x, most.y), max(most.z, most.w));
  int list = at.y * grid.x + at.x, count = 0;
  // Each round looks for the next texel so bright, and judges it: a judgement costs as much as all that threads do at the same time.
  int fours = brightest > kContrast * mean ? wide.x * wide.y / 4 : 0;
  ivec2 place = first;
  uint bright = 0u;  // bits of the texels at `place`
  for (int four = 0; four < fours || bright != 0u;) {
    for (; bright == 0u && four < fours; ++four) {
      place = first + 2 * ivec2(four % (wide.x / 2), four / (wide.x / 2));
      uvec4 above = uvec4(greaterThan(greenAround(place, true), vec4(kContrast * mean)));
      bright = above.w | above.z << 1 | above.x << 2 | above.y << 3;
    }
    int texel = max(findLSB(bright), 0);
    Highlight found = highlightAt(place + ivec2(texel & 1, texel >> 1), mean);
    bool taken = bright != 0u && found.share > 0.0;
    if (taken && count < HIGHLIGHTS) lists[list].of[count] = found;
    count += taken ? 1 : 0;
    bright &= bright - 1u;
  }
  float nearest = 0.0;
  for (int i = 0; i < (count > 0 ? 25 : 0); ++i) {
    ivec2 tile_at = clamp(at + ivec2(i % 5, i / 5) - 2, ivec2(0), grid - 1);
    nearest = max(nearest, texelFetch(tiles, tile_at, 0).r);
  }
  lists[list].count = vec4(count <= HIGHLIGHTS ? float(count) : 0.0, float(SCALE) * nearest, 0.0, 0.0);
}
