// The picture, a little darker from one frame on: a change of light that moves nothing.
// read    source   any sampler (texels are fetched)
// write   result
// params  from     number of that frame
#include "common/view.glsl"

uniform sampler2D source;
layout(std140) uniform Parameters { int from; };
out vec4 result;

void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0) * (int(frame) < from ? 1.0 : 0.9); }
