// The boxes of the town: in each block a house and three smaller things in the street beside it.
struct Box { vec3 center, half_size, color; };

float hash(uint a, uint b) {  // PCG, O'Neill 2014
  uint s = (a * 4u + b) * 747796405u + 2891336453u;
  s = ((s >> ((s >> 28) + 4u)) ^ s) * 277803737u;
  return float((s >> 22) ^ s) / 4294967296.0;
}

// Blocks are 6 wide; the town lies around the origin.
Box boxOf(uint i, int blocks) {
  uint block = i / 4u, kind = i % 4u;
  vec2 at = 6.0 * (vec2(block % uint(blocks), block / uint(blocks)) + 0.5 - 0.5 * float(blocks));
  float a = hash(block, kind), b = hash(block + 40000u, kind), c = hash(block + 90000u, kind);
  if (kind == 0u) {
    float high = 1.5 + 8.0 * a * a * a + 2.0 * b;
    vec3 wall = mix(vec3(0.75, 0.6, 0.45), mix(vec3(0.7, 0.35, 0.25), vec3(0.8, 0.8, 0.75), b), c);
    return Box(vec3(at.x, high, at.y), vec3(1.5 + 0.5 * b, high, 1.5 + 0.5 * c), wall);
  }
  vec3 half_size = vec3(0.15 + 0.25 * a, 0.15 + 0.6 * b, 0.15 + 0.25 * c);
  vec2 beside = kind == 1u ? vec2(2.5, 4.0 * (b - 0.5)) : kind == 2u ? vec2(4.0 * (c - 0.5), 2.5) : vec2(-2.5, 4.0 * (a - 0.5));
  return Box(vec3(at.x + beside.x, half_size.y, at.y + beside.y), half_size, 0.25 + 0.6 * vec3(a, c, b));
}
