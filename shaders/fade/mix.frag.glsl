// Blends the last picture over the new one while the light changes. Scene-referred, linear in radiance.
// read    before   radiance, the size of `result`, nearest; alpha 0 where there is no last picture
// modify  result   radiance, blended "premultiplied"; alpha stays where it is 1
// params  left     seconds until only the new picture is visible
// Each frame keeps left / (left + delta_time) of the last picture; the product of these shares falls to 0 linearly.
#include "common/view.glsl"

uniform sampler2D before;
layout(std140) uniform Parameters { float left; };
out vec4 result;

void main() {
  vec4 last = texelFetch(before, ivec2(gl_FragCoord.xy), 0);
  float share = last.a > 0.5 ? left / (left + delta_time) : 0.0;  // at edges alpha is 1 except for rounding
  result = vec4(last.rgb * share, share);
}
