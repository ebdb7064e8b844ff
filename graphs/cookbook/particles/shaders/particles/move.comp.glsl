// Moves each particle by a frame; a dead one is born anew at the spout.
// read    before   Particle[], of the frame before
// write   swarm    the same
#include "common/view.glsl"
#include "particle.glsl"
layout(local_size_x = 64) in;

layout(std430) readonly buffer before { Particle old[]; };
layout(std430) writeonly buffer swarm { Particle particle[]; };
layout(std140) uniform Parameters { float life; vec3 wind; };

uint seed;
float random() {  // PCG, O'Neill 2014
  seed = seed * 747796405u + 2891336453u;
  uint word = ((seed >> ((seed >> 28) + 4u)) ^ seed) * 277803737u;
  return float((word >> 22) ^ word) / 4294967296.0;
}

void main() {
  uint at = gl_GlobalInvocationID.x;
  if (at >= uint(old.length())) return;
  Particle self = old[at];
  float step = delta_time > 0.0 ? min(delta_time, 0.05) : 1.0 / 60.0;
  if (self.age >= self.life) {
    seed = at * 9781u + frame * 6271u + 1u;
    random();
    float angle = 6.2831853 * random(), spread = 0.7 * sqrt(random());
    bool first = self.life == 0.0;
    self.position = vec3(0.0);
    self.velocity = vec3(spread * cos(angle), 2.5 + 3.0 * random(), spread * sin(angle));
    self.life = life * (0.5 + 0.5 * random());
    // At the start they are born one after the other.
    self.age = first ? -life * random() : 0.0;
  }
  self.age += step;
  if (self.age > 0.0) {
    self.velocity += step * (vec3(0.0, -4.0, 0.0) + 0.6 * (wind - self.velocity));
    self.position += step * self.velocity;
    if (self.position.y < 0.0) {
      self.position.y = 0.0;
      self.velocity *= vec3(0.6, -0.4, 0.6);
    }
  }
  particle[at] = self;
}
