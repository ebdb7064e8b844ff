// read    radiance
// write   result     encoded picture
#include "common/srgb.glsl"

uniform sampler2D radiance;
out vec4 result;

void main() {
  vec3 color = texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb;
  result = vec4(encodeSrgb(clamp(color / (1.0 + 0.3 * color), 0.0, 1.0)), 1.0);
}
