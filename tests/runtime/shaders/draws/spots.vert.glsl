// Vertices from a buffer; what they are connected to is the pass's "geometry".
// read    spots
// params  first
layout(std430) readonly buffer spots { vec4 spot[]; };
layout(std140) uniform Parameters { int first; };
flat out float value;

void main() {
  vec4 own = spot[first + gl_VertexID];
  gl_Position = vec4(own.xy / 8.0 - 1.0, 0.5, 1.0);
  gl_PointSize = own.z;
  value = own.w;
}
