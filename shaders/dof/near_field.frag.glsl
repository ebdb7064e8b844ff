// The blurred near field over the rest. Scene-referred.
// read    blurred  from fill, `as linear`: premultiplied
// modify  result   radiance, with "blend": "premultiplied"
uniform sampler2D blurred;
out vec4 result;
#include "coc.glsl"

void main() {
  result = textureLod(blurred, gl_FragCoord.xy / float(SCALE) / vec2(textureSize(blurred, 0)), 0.0);
  // What is covered except for rounding is covered: a bright light there would become a spot.
  result *= result.a > 0.995 ? 1.0 / result.a : 1.0;
}
