// The surfaces of the pixel, from far to near: each time through the list finds the next.
// read    last, nodes   see glass/collect.frag.glsl
//         behind        what is seen without them
// write   radiance
#include "common/view.glsl"
#include "node.glsl"

uniform sampler2D behind;
layout(std430) readonly buffer last { uint newest[]; };
layout(std430) readonly buffer nodes { uint count; uint unused[3]; Node node[]; };
out vec4 radiance;

void main() {
  uint first = newest[int(gl_FragCoord.y) * int(viewport.x) + int(gl_FragCoord.x)];
  vec3 light = texelFetch(behind, ivec2(gl_FragCoord.xy), 0).rgb;
  // Depth is reversed: what is farther has less. Of equal ones, the older comes first.
  uvec2 done = uvec2(0u);
  for (int k = 0; k < 64; ++k) {
    uvec2 next = uvec2(0xffffffffu, 0u);
    for (uint at = first; at != 0u; at = node[at - 1u].before) {
      uvec2 self = uvec2(node[at - 1u].depth, at);
      bool left = self.x > done.x || (self.x == done.x && self.y > done.y);
      if (left && (self.x < next.x || (self.x == next.x && self.y < next.y))) next = self;
    }
    if (next.y == 0u) break;
    vec4 shell = vec4(unpackHalf2x16(node[next.y - 1u].color), unpackHalf2x16(node[next.y - 1u].glow));
    light = shell.rgb + (1.0 - shell.a) * light;
    done = next;
  }
  radiance = vec4(light, 1.0);
}
