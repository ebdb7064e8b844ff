// What is out of focus, at full size: the blurred layer that is not before the focus, where before.frag.glsl covers it too. Scene-referred.
// read    source   radiance; any sampler (texels are fetched)
//         depth    reversed-Z; any sampler
//         blurred  from fill, `as linear`
// write   result   radiance; in focus the source bit for bit; alpha is the source's
// params  infinity, focus, largest   as in split
#include "common/finite.glsl"
#include "coc.glsl"

uniform sampler2D source, depth, blurred;
layout(std140) uniform Parameters {
  float infinity;
  float focus;
  int largest;
};
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 own = texelFetch(source, at, 0);
  float radius = cocRadius(texelFetch(depth, at, 0).r, infinity, focus, float(largest) - 1.0);
  // Small discs before the focus lie on the sharp picture: their surface runs on into the focus, and nothing else is behind it.
  float blur = radius < 0.0 ? smoothstep(1.0, 4.0, -radius) : blurOf(radius);
  vec4 layer = textureLod(blurred, gl_FragCoord.xy * 0.5 / vec2(textureSize(blurred, 0)), 0.0);
  result = vec4(blur > 0.0 ? mix(finite(own.rgb), layer.rgb / max(layer.a, 1e-4), blur) : own.rgb, own.a);
}
