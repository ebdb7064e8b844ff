// A dot that goes round, over what is left of the frame before.
// read    before   the mean of the frame before
// write   mean     that of this frame
#include "common/view.glsl"

uniform sampler2D before;
layout(std140) uniform Parameters { float keep; };
in vec2 uv;
out vec4 mean;

void main() {
  vec2 center = viewport * (0.5 + 0.3 * vec2(cos(6.0 * time), sin(6.0 * time)));
  float inside = 1.0 - smoothstep(0.0, 2.0, distance(gl_FragCoord.xy, center) - 0.06 * viewport.y);
  vec3 now = inside * vec3(1.0, 0.6, 0.2);
  mean = vec4(max(now, keep * texelFetch(before, ivec2(gl_FragCoord.xy), 0).rgb), 1.0);
}
