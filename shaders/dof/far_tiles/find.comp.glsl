// What there is to do in the tiles of the far field. Where all discs in and around a tile are alike, even.comp.glsl blurs it, else
// far_bokeh.frag.glsl.
// read    discs    from split
//         source   from split, the far field
//         idle     from split
// write   tiles    the radius of the discs in texels of the fields: 0 where nothing is blurred, -1 where discs differ; the largest radius,
//                  in pixels, of the discs in and around the tile that small/gather.comp.glsl gathers, 0 where there are none
//         work     its work groups, and their tiles
// defines EACH_TEXEL   see disc.glsl
//         FAR_TILE     texels of the fields along a tile's side
//         POLYGON
layout(local_size_x = 8, local_size_y = 8) in;
#include "dof/coc.glsl"
#include "dof/idle.glsl"
#define WORK_ACCESS
#include "dof/small/work.glsl"

uniform sampler2D discs, source, idle;
layout(rg16f) uniform writeonly image2D tiles;

const float kAlike = 1.02;                    // ratio of radii that count as one
const float kLeast = POLYGON == 1 ? 2.3 : 1.5;  // radius from which texelWithin() has weights by areas
const int kAround = 4;                        // texels around a tile that its discs may reach, at least EACH_TEXEL

void addWork(ivec2 tile) {
  uint i = atomicAdd(count, 1u);
  tiles_of[i] = uint(tile.x + (tile.y << 16));
  atomicMax(groups.x, min(i + 1u, kAcross));
  atomicMax(groups.y, i / kAcross + 1u);
  groups.z = 1u;
}

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(tiles)))) return;
  ivec2 size = textureSize(discs, 0), first = at * FAR_TILE, end = min(first + FAR_TILE, size);
  ivec2 low = max(first - kAround, ivec2(0)), high = min(end + kAround, size);
  vec4 least = vec4(1e4), most = vec4(0.0), nearer = vec4(0.0), small = vec4(0.0), lowest = vec4(0.5), highest = vec4(0.5);
  // Four texels at a time: sizes and tiles are even.
  for (int y = low.y; y < high.y; y += 2)
    for (int x = low.x; x < high.x; x += 2) {
      vec2 middle = vec2(x + 1, y + 1) / vec2(size);
      vec4 shares = textureGather(source, middle, 3), radii = textureGather(discs, middle, 1) / max(shares, vec4(1e-4));
      most = max(most, radii);
      least = min(least, mix(vec4(1e4), radii, greaterThan(radii, vec4(kLeastRadius))));
      vec4 work = textureGather(idle, middle);
      small = max(small, smallIn(work));
      bool inside = clamp(ivec2(x, y), first, end - 1) == ivec2(x, y);
      nearer = inside ? max(nearer, textureGather(discs, middle, 0)) : nearer;
      lowest = inside ? min(lowest, work) : lowest;
      highest = inside ? max(highest, work) : highest;
    }
  least.xy = min(least.xy, least.zw), most.xy = max(most.xy, most.zw), small.xy = max(small.xy, small.zw);
  float narrow = min(least.x, least.y), wide = max(most.x, most.y), largest = max(small.x, small.y);
  // Behind the near field, far_hidden has work; beside it the far field is filled, as a near disc may be narrower than a texel.
  bool busy = any(lessThan(lowest, vec4(kBusy))), hidden = any(greaterThan(highest, vec4(kHidden)));
  bool alone = largest < 0.5 && all(equal(nearer, vec4(0.0)));
  bool even = SCALE == 2 && alone && wide >= narrow && wide <= kAlike * narrow && narrow > kLeast && wide <= float(EACH_TEXEL);
  imageStore(tiles, at, vec4(!busy && !hidden ? 0.0 : even ? wide : -1.0, largest < 0.5 ? 0.0 : largest, 0.0, 0.0));
  if (largest >= 0.5) addWork(at);
}
