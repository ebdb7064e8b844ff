// The last picture over the one that new light makes. Scene-referred, linear in radiance.
// read    before   radiance, the size of `result`, nearest; alpha 0 where there is no last picture
// modify  result   radiance, blended "premultiplied"; alpha stays where it is 1
// params  left     seconds until only the new light is seen
// Frame by frame left / (left + delta_time) of the last picture remain: the product of these shares falls to 0 in a straight line.
#include "common/view.glsl"

uniform sampler2D before;
layout(std140) uniform Parameters { float left; };
out vec4 result;

void main() {
  vec4 last = texelFetch(before, ivec2(gl_FragCoord.xy), 0);
  float share = last.a > 0.5 ? left / (left + delta_time) : 0.0;  // at edges alpha is 1 but for rounding
  result = vec4(last.rgb * share, share);
}
