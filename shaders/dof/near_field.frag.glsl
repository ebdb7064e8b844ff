// The blurred near field over the rest. Scene-referred.
// read    blurred  from fill, `as linear`: premultiplied
// modify  result   radiance, with "blend": "premultiplied"
uniform sampler2D blurred;
out vec4 result;
#include "coc.glsl"

void main() { result = textureLod(blurred, gl_FragCoord.xy / float(SCALE) / vec2(textureSize(blurred, 0)), 0.0); }
