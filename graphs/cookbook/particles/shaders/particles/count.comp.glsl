// The keys by which particles are sorted, far ones first, dead ones last; and the command that draws those alive.
// read    swarm      Particle[]
// write   keys       uvec2[]: key, index of the particle
// modify  commands   what glDrawArraysIndirect takes
#include "common/view.glsl"
#include "particle.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer swarm { Particle particle[]; };
layout(std430) writeonly buffer keys { uvec2 key[]; };
layout(std430) buffer commands { uint vertices; uint instances; uint first; uint base; };

void main() {
  uint at = gl_GlobalInvocationID.x;
  if (at >= uint(particle.length())) return;
  if (at == 0u) instances = 1u;
  bool alive = particle[at].age > 0.0 && particle[at].age < particle[at].life;
  if (alive) atomicAdd(vertices, 1u);
  // Bits of floats that are not negative have the order of the floats.
  float distance = distance(eye, particle[at].position);
  key[at] = uvec2(alive ? ~floatBitsToUint(distance) & 0x7fffffffu : 0xffffffffu, at);
}
