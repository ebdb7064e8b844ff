// The longest motion in each tile (McGuire et al., "A reconstruction filter for plausible motion blur", I3D 2012).
// read    velocity   screen UV per frame; any sampler (texels are fetched)
// write   result     screen UV per frame, one texel per tile
// params  tile       pixels along a tile's side
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D velocity;
layout(rg16f) uniform writeonly image2D result;
layout(std140) uniform Parameters { int tile; };

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(at, imageSize(result)))) return;
  ivec2 size = textureSize(velocity, 0), first = at * tile, end = min(first + tile, size);
  vec2 longest = vec2(0.0);
  float length2 = 0.0;
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) {
      vec2 v = texelFetch(velocity, ivec2(x, y), 0).rg, pixels = v * vec2(size);
      float l = dot(pixels, pixels);
      if (l > length2) {
        length2 = l;
        longest = v;
      }
    }
  imageStore(result, at, vec4(longest, 0.0, 0.0));
}
