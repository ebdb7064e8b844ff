// A ramp from left to right, linear in radiance or, with ENCODED, in sRGB encoded values. A test picture.
// write   result
// params  left, right  values at the outermost texels
//         first        factor of frame 0, so that later frames see a jump
//         encoded      define, default 0
#include "common/view.glsl"
#ifndef ENCODED
#define ENCODED 0
#endif
layout(std140) uniform Parameters {
  vec3 left;
  vec3 right;
  float first;
};
out vec4 result;

void main() {
  vec3 c = mix(left, right, (gl_FragCoord.x - 0.5) / max(viewport.x - 1.0, 1.0));
#if ENCODED
  c = mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
#endif
  result = vec4(c * (frame == 0u ? first : 1.0), 1.0);
}
