// Puts the surface at the end of the list of its pixel.
// modify  last    the newest node of each pixel, from 1 on; 0: none
//         nodes   a count, and the nodes
#include "surface.glsl"
#include "node.glsl"

layout(std430) buffer last { uint newest[]; };
layout(std430) buffer nodes { uint count; uint unused[3]; Node node[]; };

void main() {
  vec4 shell = shell();
  uint at = atomicAdd(count, 1u);
  if (at >= uint(node.length())) return;
  uint before = atomicExchange(newest[int(gl_FragCoord.y) * int(viewport.x) + int(gl_FragCoord.x)], at + 1u);
  node[at] = Node(before, packHalf2x16(shell.rg), packHalf2x16(shell.ba), floatBitsToUint(gl_FragCoord.z));
}
