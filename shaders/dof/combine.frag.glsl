// Depth of field at full size: the sharp picture, behind it and before it the blurred layers. Scene-referred.
// read    source   radiance; any sampler (texels are fetched)
//         depth    reversed-Z
//         fields   layer 0 before the focus, layer 1 the rest, from bokeh; `as linear`
// write   result   radiance; in focus the source bit for bit; alpha is the source's
// params  infinity, focus, largest   as in split
#include "common/finite.glsl"
#include "coc.glsl"

uniform sampler2D source, depth;
uniform sampler2DArray fields;
layout(std140) uniform Parameters {
  float infinity;
  float focus;
  int largest;
};
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 own = texelFetch(source, at, 0);
  float blur = blurOf(cocRadius(texelFetch(depth, at, 0).r, infinity, focus, float(largest) - 1.0));
  vec2 uv = gl_FragCoord.xy * 0.5 / vec2(textureSize(fields, 0).xy);
  if (blur > 0.0) {
    vec4 behind = textureLod(fields, vec3(uv, 1.0), 0.0);
    own.rgb = mix(finite(own.rgb), behind.rgb / max(behind.a, 1e-4), blur);
  }
  vec4 before = textureLod(fields, vec3(uv, 0.0), 0.0);
  if (before.a > 0.0) own.rgb = finite(own.rgb) * (1.0 - before.a) + before.rgb;
  result = own;
}
