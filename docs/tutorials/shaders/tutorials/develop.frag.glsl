// An old print: the picture in the colors of a ramp where the mask is white, with grain.
// read    background   linear light
//         ramp         a row of colors for display, from those of black to those of white
//         mask         red: how much of the ramp
//         noise        red: evenly spread, repeated
// write   result       for display
#include "common/srgb.glsl"

uniform sampler2D background, ramp, mask, noise;
layout(std140) uniform Parameters { float grain; };
in vec2 uv;
out vec4 result;

void main() {
  vec3 color = texture(background, uv).rgb;
  vec3 shown = encodeSrgb(color);
  float gray = encodeSrgb(vec3(dot(color, vec3(0.2126, 0.7152, 0.0722)))).r;
  // From the middle of the first texel to that of the last.
  float width = float(textureSize(ramp, 0).x);
  vec3 toned = texture(ramp, vec2((gray * (width - 1.0) + 0.5) / width, 0.5)).rgb;
  float speck = texture(noise, gl_FragCoord.xy / vec2(textureSize(noise, 0))).r - 0.5;
  result = vec4(mix(shown, toned, texture(mask, uv).r) + grain * speck, 1.0);
}
