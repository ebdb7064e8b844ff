// For each tile of 16 x 16 pixels, the lamps that may reach a surface in it; see clusters.glsl. A work group is a tile.
// read    depth     the G-buffer's
//         lamps     see scene/lamps.glsl
// modify  clusters  uints: words of each tile, row by row, then of each slice; a word has 32 lamps
// params  lamp_count
#include "clusters.glsl"
#include "gbuffer.glsl"
#include "scene/lamps.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
uniform sampler2D depth;
layout(std430) buffer clusters { uint cluster[]; };
layout(std140) uniform Parameters { int lamp_count; };

shared uint nearest, farthest;  // depths as bits: positive floats are ordered as they are
shared uint words[8];

// Signed distance of `at` (view space) from the plane through all points of the target at `ndc` of one axis; positive to the right or above.
float beside(vec3 at, int axis, float ndc) {
  if (projection[3].w == 0.0) {
    float slope = (ndc + projection[2][axis]) / projection[axis][axis];
    return (at[axis] + slope * at.z) * inversesqrt(1.0 + slope * slope);
  }
  return at[axis] - (ndc - projection[3][axis]) / projection[axis][axis];
}

void main() {
  ivec2 size = textureSize(depth, 0), tile = ivec2(gl_WorkGroupID.xy), tiles = tilesOf(size), pixel = ivec2(gl_GlobalInvocationID.xy);
  int lane = int(gl_LocalInvocationIndex), count = wordsOf(lamp_count);
  if (lane == 0) {
    nearest = 0u;
    farthest = 0xffffffffu;
  }
  barrier();
  float z = all(lessThan(pixel, size)) ? texelFetch(depth, pixel, 0).r : 0.0;
  if (z > 0.0) {
    atomicMax(nearest, floatBitsToUint(z));
    atomicMin(farthest, floatBitsToUint(z));
  }
  barrier();
  bool empty = nearest == 0u;
  vec2 low = vec2(tile * kTile) / vec2(size) * 2.0 - 1.0, high = min(vec2((tile + 1) * kTile) / vec2(size), 1.0) * 2.0 - 1.0;
  vec2 middle = 0.25 * (low + high) + 0.5;
  float from = 0.0, to = 0.0;
  if (!empty) {
    from = viewDistance(positionOfDepth(middle, uintBitsToFloat(nearest))) * 0.9999;
    to = viewDistance(positionOfDepth(middle, uintBitsToFloat(farthest))) * 1.0001;
  }

  // 256 lamps at a time, one for each lane.
  for (int first = 0; first < count; first += 8) {
    if (lane < 8) words[lane] = 0u;
    barrier();
    int i = first * 32 + lane;
    if (i < lamp_count && !empty) {
      vec4 bounds = lampBounds(lamp[i]);
      vec3 at = (view * vec4(bounds.xyz, 1.0)).xyz;
      float reach = bounds.w * 1.001;
      bool within = -at.z + reach >= from && -at.z - reach <= to && beside(at, 0, low.x) >= -reach && beside(at, 0, high.x) <= reach &&
                    beside(at, 1, low.y) >= -reach && beside(at, 1, high.y) <= reach;
      if (within) atomicOr(words[lane >> 5], 1u << (lane & 31));
    }
    barrier();
    if (lane < 8 && first + lane < count && all(lessThan(tile, tiles)))
      cluster[(tile.y * tiles.x + tile.x) * count + first + lane] = ~words[lane];
    barrier();
  }
}
