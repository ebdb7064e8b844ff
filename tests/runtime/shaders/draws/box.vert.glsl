// A box of 4 by 4 texels, seen along z.
// params  corner   in texels
in vec3 position, normal;
layout(std140) uniform Parameters { vec2 corner; };
flat out float value;

void main() {
  gl_Position = vec4((position.xy * 2.0 + corner + 2.0) / 8.0 - 1.0, 0.5 - 0.25 * position.z, 1.0);
  value = normal.z + 2.0;
}
