// Light times the color of the surface, on the display.
// read    light, albedo
// write   result   encoded picture
#include "common/srgb.glsl"

uniform sampler2D light, albedo;
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 radiance = 0.7 * texelFetch(light, at, 0).rgb * texelFetch(albedo, at, 0).rgb;
  result = vec4(encodeSrgb(radiance / (1.0 + radiance)), 1.0);
}
