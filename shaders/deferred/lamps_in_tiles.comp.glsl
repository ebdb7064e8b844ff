// For each tile, the lamps that may light what is visible in it; see clusters.glsl. A work group is a tile.
// read    depth?     the G-buffer's; without it `clusters` equals `columns`
//         lamps      see scene/lamps.glsl
// modify  clusters?  uints: words of each tile, row by row; a word has 32 lamps. For the depths of the G-buffer
//         columns?   the same for any depth
// params  lamp_count
//         picture    size in pixels
#include "clusters.glsl"
#include "gbuffer.glsl"
#include "scene/lamps.glsl"

layout(local_size_x = LAMP_TILE, local_size_y = LAMP_TILE) in;
#ifdef HAS_DEPTH
uniform sampler2D depth;
shared uint nearest, farthest;  // depths as bits: the bits of positive floats have the order of the floats
#endif
#ifdef HAS_CLUSTERS
layout(std430) buffer clusters { uint cluster[]; };
#endif
#ifdef HAS_COLUMNS
layout(std430) buffer columns { uint column[]; };
#endif
layout(std140) uniform Parameters {
  int lamp_count;
  vec2 picture;
};

const int kLanes = LAMP_TILE * LAMP_TILE, kWords = kLanes / 32;
shared uint of_surfaces[kWords], of_all[kWords];

// Signed distance of `at` (view space) from the plane through all points of the target at `ndc` of one axis; positive to the right or
// above.
float beside(vec3 at, int axis, float ndc) {
  if (projection[3].w == 0.0) {
    float slope = (ndc + projection[2][axis]) / projection[axis][axis];
    return (at[axis] + slope * at.z) * inversesqrt(1.0 + slope * slope);
  }
  return at[axis] - (ndc - projection[3][axis]) / projection[axis][axis];
}

void main() {
  ivec2 size = ivec2(picture), tile = ivec2(gl_WorkGroupID.xy), tiles = tilesOf(size);
  int lane = int(gl_LocalInvocationIndex), count = wordsOf(lamp_count), at = (tile.y * tiles.x + tile.x) * count;
  vec2 low = vec2(tile * LAMP_TILE) / picture * 2.0 - 1.0, high = min(vec2((tile + 1) * LAMP_TILE) / picture, 1.0) * 2.0 - 1.0;
  // Distances of the surfaces in the tile; none where to < from.
  float from = -1e30, to = 1e30;
#ifdef HAS_DEPTH
  if (lane == 0) {
    nearest = 0u;
    farthest = 0xffffffffu;
  }
  barrier();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  float z = all(lessThan(pixel, size)) ? texelFetch(depth, pixel, 0).r : 0.0;
  if (z > 0.0) {
    atomicMax(nearest, floatBitsToUint(z));
    atomicMin(farthest, floatBitsToUint(z));
  }
  barrier();
  vec2 middle = 0.25 * (low + high) + 0.5;
  from = to = -1e30;
  if (nearest != 0u) {
    from = viewDistance(positionOfDepth(middle, uintBitsToFloat(nearest))) * 0.9999;
    to = viewDistance(positionOfDepth(middle, uintBitsToFloat(farthest))) * 1.0001;
  }
#endif

  // One lamp per lane at a time.
  for (int first = 0; first < count; first += kWords) {
    if (lane < kWords) of_surfaces[lane] = of_all[lane] = 0u;
    barrier();
    int i = first * 32 + lane;
    if (i < lamp_count) {
      vec4 bounds = lampBounds(lamp[i]);
      vec3 center = (view * vec4(bounds.xyz, 1.0)).xyz;
      float reach = bounds.w * 1.001;
      if (beside(center, 0, low.x) >= -reach && beside(center, 0, high.x) <= reach && beside(center, 1, low.y) >= -reach &&
          beside(center, 1, high.y) <= reach) {
        uint bit = 1u << (lane & 31);
        atomicOr(of_all[lane >> 5], bit);
        if (-center.z + reach >= from && -center.z - reach <= to) atomicOr(of_surfaces[lane >> 5], bit);
      }
    }
    barrier();
    if (lane < kWords && first + lane < count && all(lessThan(tile, tiles))) {
#ifdef HAS_CLUSTERS
      cluster[at + first + lane] = ~of_surfaces[lane];
#endif
#ifdef HAS_COLUMNS
      column[at + first + lane] = ~of_all[lane];
#endif
    }
    barrier();
  }
}
