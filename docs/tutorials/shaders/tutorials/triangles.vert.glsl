// 300 triangles at random places and depths. Clip space by hand: z is 0 far away and 1 near.
flat out vec3 tint;

float random(float seed) { return fract(sin(seed * 12.9898) * 43758.5453); }

void main() {
  float i = float(gl_InstanceID), angle = 6.2832 * (random(i) + float(gl_VertexID) / 3.0);
  vec2 center = 2.0 * vec2(random(i + 0.3), random(i + 0.6)) - 1.0;
  tint = 0.6 * vec3(random(i + 0.1), random(i + 0.2), random(i + 0.4));
  gl_Position = vec4(center + 0.25 * vec2(cos(angle), sin(angle)), random(i + 0.7), 1.0);
}
