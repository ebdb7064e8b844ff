// The longest motion in each tile (McGuire et al., "A reconstruction filter for plausible motion blur", I3D 2012), and the one that differs
// most from it.
// read    velocity   screen UV per frame; any sampler (texels are fetched)
// write   result     screen UV per frame, one texel per tile: both motions
// params  tile       pixels along a tile's side
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D velocity;
layout(rgba16f) uniform writeonly image2D result;
layout(std140) uniform Parameters { int tile; };

// The motion in a tile that is farthest from `from`. Four texels at a time. At an odd end some are read twice or from the next tile, which
// is harmless.
vec2 farthest(vec2 from, ivec2 first, ivec2 end, vec2 size) {
  vec2 found = from;
  float length2 = 0.0;
  for (int y = first.y; y < end.y; y += 2)
    for (int x = first.x; x < end.x; x += 2) {
      vec2 middle = vec2(x + 1, y + 1) / size;
      vec4 across = textureGather(velocity, middle, 0), up = textureGather(velocity, middle, 1);
      vec4 dx = (across - from.x) * size.x, dy = (up - from.y) * size.y, lengths = dx * dx + dy * dy;
      float most = max(max(lengths.x, lengths.y), max(lengths.z, lengths.w));
      if (most > length2) {
        length2 = most;
        vec4 is = vec4(equal(lengths, vec4(most)));
        found = is.x > 0.0 ? vec2(across.x, up.x)
              : is.y > 0.0 ? vec2(across.y, up.y)
              : is.z > 0.0 ? vec2(across.z, up.z) : vec2(across.w, up.w);
      }
    }
  return found;
}

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(result)))) return;
  ivec2 size = textureSize(velocity, 0), first = at * tile, end = min(first + tile, size);
  vec2 longest = farthest(vec2(0.0), first, end, vec2(size)), pixels = longest * vec2(size);
  // Of a tile that moves less than a hundredth of a pixel, as by rounding, all motions are alike.
  vec2 other = dot(pixels, pixels) < 1e-4 ? longest : farthest(longest, first, end, vec2(size));
  imageStore(result, at, vec4(longest, other));
}
