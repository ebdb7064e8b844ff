// A particle as a point, as large as it looks.
// read    swarm   Particle[]
//         keys    uvec2[]: y is the index of the particle
#include "common/view.glsl"
#include "particle.glsl"

layout(std430) readonly buffer swarm { Particle particle[]; };
layout(std430) readonly buffer keys { uvec2 key[]; };
out vec4 color;

void main() {
  Particle self = particle[key[gl_VertexID].y];
  float age = self.age / self.life;
  gl_Position = view_projection * vec4(self.position, 1.0);
  gl_PointSize = clamp(0.5 * viewport.y * projection[1].y * 0.06 * (0.5 + age) / gl_Position.w, 1.0, 64.0);
  float alpha = smoothstep(0.0, 0.1, age) * smoothstep(1.0, 0.6, age) * 0.8;
  color = vec4(mix(vec3(1.0, 0.85, 0.4), vec3(0.8, 0.15, 0.35), age) * alpha, alpha);
}
