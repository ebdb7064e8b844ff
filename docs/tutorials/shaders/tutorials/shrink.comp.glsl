// read   source  `as linear`
// write  result  a level of half the size
layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D source;
layout(rgba16f) uniform writeonly image2D result;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(result);
  if (any(greaterThanEqual(at, size))) return;
  imageStore(result, at, textureLod(source, (vec2(at) + 0.5) / vec2(size), 0.0));
}
