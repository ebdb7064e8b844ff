// A rectangle, in texels of 16 by 16, from the front or from the back.
// params  rect, color, height, back
layout(std140) uniform Parameters { vec4 rect, color; float height, back; };

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  if (back != 0.0) corner.x = 1.0 - corner.x;
  gl_Position = vec4(mix(rect.xy, rect.zw, corner) / 8.0 - 1.0, height, 1.0);
}
