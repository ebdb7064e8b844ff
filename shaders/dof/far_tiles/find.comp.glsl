// What there is to do in the tiles of the far field. Where all discs in and around a tile are alike, even.comp.glsl blurs it, else
// far_bokeh.frag.glsl.
// read    discs    from split
//         source   from split, the far field
// write   tiles    the radius of the discs in texels of the fields: 0 where nothing is blurred, -1 where discs differ
// defines EACH_TEXEL   see disc.glsl
//         FAR_TILE     texels of the fields along a tile's side
//         POLYGON
layout(local_size_x = 8, local_size_y = 8) in;
#include "dof/coc.glsl"

uniform sampler2D discs, source;
layout(r16f) uniform writeonly image2D tiles;

const float kAlike = 1.02;                    // ratio of radii that count as one
const float kLeast = POLYGON == 1 ? 2.3 : 1.5;  // radius from which texelWithin() has weights by areas
const int kAround = 4;                        // texels around a tile that its discs may reach, at least EACH_TEXEL

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(tiles)))) return;
  ivec2 size = textureSize(discs, 0), first = at * FAR_TILE, end = min(first + FAR_TILE, size);
  ivec2 low = max(first - kAround, ivec2(0)), high = min(end + kAround, size);
  vec4 least = vec4(1e4), most = vec4(0.0), busy = vec4(0.0), hidden = vec4(0.0), nearer = vec4(0.0);
  // Four texels at a time: sizes and tiles are even.
  for (int y = low.y; y < high.y; y += 2)
    for (int x = low.x; x < high.x; x += 2) {
      vec2 middle = vec2(x + 1, y + 1) / vec2(size);
      vec4 shares = textureGather(source, middle, 3), radii = textureGather(discs, middle, 1) / max(shares, vec4(1e-4));
      most = max(most, radii);
      least = min(least, mix(vec4(1e4), radii, greaterThan(radii, vec4(kLeastRadius))));
      bool inside = clamp(ivec2(x, y), first, end - 1) == ivec2(x, y);
      busy = inside ? max(busy, radii) : busy;
      vec4 in_front = textureGather(discs, middle, 0);
      nearer = inside ? max(nearer, in_front) : nearer;
      hidden = inside ? max(hidden, mix(in_front, vec4(0.0), greaterThan(shares, vec4(0.0)))) : hidden;
    }
  least.xy = min(least.xy, least.zw), most.xy = max(most.xy, most.zw), busy.xy = max(busy.xy, busy.zw);
  float narrow = min(least.x, least.y), wide = max(most.x, most.y);
  // Behind the near field, far_hidden has work; beside it the far field is filled, as a near disc may be narrower than a texel.
  bool is_hidden = any(greaterThan(hidden, vec4(kLeastRadius)));
  bool even = SCALE == 2 && all(equal(nearer, vec4(0.0))) && wide >= narrow && wide <= kAlike * narrow && narrow > kLeast && wide <= float(EACH_TEXEL);
  imageStore(tiles, at, vec4(!is_hidden && max(busy.x, busy.y) <= kLeastRadius ? 0.0 : even ? wide : -1.0));
}
