// Each luminance becomes that of the display which as large a share of the pixels is below, by the logarithm.
// read    color    scene-referred
//         curve    float[BINS + 1], 0 to 1
// write   result   encoded picture
#include "common/srgb.glsl"

uniform sampler2D color;
layout(std430) readonly buffer curve { float share[]; };
layout(std140) uniform Parameters { float darkest; float stops; float contrast; };
in vec2 uv;
out vec4 result;

void main() {
  vec3 radiance = texelFetch(color, ivec2(gl_FragCoord.xy), 0).rgb;
  float luminance = max(dot(radiance, vec3(0.2126, 0.7152, 0.0722)), exp2(darkest));
  float at = clamp((log2(luminance) - darkest) / stops * float(BINS), 0.0, float(BINS) - 0.001);
  float below = mix(share[int(at)], share[int(at) + 1], fract(at));
  float shown = exp2((below - 1.0) * log2(contrast));
  result = vec4(encodeSrgb(clamp(radiance * (shown / luminance), 0.0, 1.0)), 1.0);
}
